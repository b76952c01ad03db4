// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <measure/picture.h>

/// Pictures for tests.
namespace pictures {

using Rgb8 = std::array<std::uint8_t, 3>;

/// One colour everywhere.
measure::Picture constant(int width, int height, const Rgb8& color);

/// Squares of 16 pixels in two colours, moved by so many pixels with the picture's sides joined.
measure::Picture checker(int width, int height, int shift_x, int shift_y);

/// A grey disc of the radius before black, its light times `scale`.
measure::Picture disc(int side, double radius, float scale);

/// The picture with independent normal noise of that standard deviation, cut off at black.
measure::Picture noisy(measure::Picture picture, double sigma, std::uint64_t seed);

/// A folder of its own, gone at the end.
class Folder {
public:
    Folder();
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    const std::filesystem::path& path() const { return path_; }
    /// Every file below it, by its path from here, sorted.
    std::vector<std::string> files() const;

private:
    std::filesystem::path path_;
};

/// Write values as a PNG of 8 or 16 bits, as an EXR file of floats; channels by count: Y, YA, RGB, RGBA.
void write_png8(const std::filesystem::path& file, int width, int height, int channels,
                const std::vector<std::uint8_t>& values);
void write_png16(const std::filesystem::path& file, int width, int height, int channels,
                 const std::vector<std::uint16_t>& values);
void write_exr(const std::filesystem::path& file, int width, int height, int channels,
               const std::vector<float>& values);

/// A 32 x 24 PNG of one colour with a square of another in its middle.
void write_square(const std::filesystem::path& file, const Rgb8& color);

} // namespace pictures
