// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace measure {

/// An image to be measured. Rows run from the top down.
struct Picture {
    std::string name; ///< stands in errors
    int width = 0, height = 0;
    std::vector<float> linear; ///< RGB, linear Rec. 709, 1 being the display's white; finite
    std::vector<float>
        coverage; ///< share of each pixel that the object covers; empty where the file has none

    std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

/// Read a PNG (sRGB, 8 or 16 bits; light that its alpha does not let through is black) or an OpenEXR file
/// (linear light, R, G, B or Y, with or without A). Throws support::InputError for anything else, a part of
/// an image, more than 64 million pixels, and numbers that are not finite.
Picture read_picture(const std::filesystem::path& file);

/// Which pixels show the object: where either picture's coverage is above zero or, of a picture without
/// coverage, where its colour is not the background's. The background is the colour that the borders of both
/// pictures hold most often; where one of the borders has none of it, every pixel counts. One value, 0 or 1,
/// a pixel. Throws support::InputError for pictures of two sizes, and for a picture that shows nothing but
/// background.
std::vector<unsigned char> object_pixels(const Picture& image, const Picture& reference);

} // namespace measure
