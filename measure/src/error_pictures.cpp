// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "error_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <OpenImageIO/imageio.h>

#include <renderer/optics/color.h>
#include <support/error.h>

namespace measure {
namespace {

std::uint8_t byte_of(double value) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

void write_png(const std::filesystem::path& file, const std::vector<std::uint8_t>& rgb, int width,
               int height) {
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    spec["oiio:ColorSpace"] = "sRGB";
    spec["png:compressionLevel"] = 4; // a quarter of the default's time for a few per cent more bytes
    const auto output = OIIO::ImageOutput::create(file.string());
    if (!output || !output->open(file.string(), spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, rgb.data()) || !output->close()) {
        throw support::failure("{}: cannot be written: {}", file.string(),
                               output ? output->geterror() : OIIO::geterror());
    }
}

/// A helix about the diagonal of greys [Green2011, Eqs. 1-2], started between blue and red and turned most of
/// a round, so that it passes purple, red and yellow.
std::array<double, 3> cubehelix(double value) {
    constexpr double start = 0.2, turns = 0.6, hue = 1.3;
    const double angle = 2 * std::numbers::pi * (start / 3 + 1 + turns * value);
    const double amplitude = hue * value * (1 - value) / 2;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {value + amplitude * (-0.14861 * c + 1.78277 * s),
            value + amplitude * (-0.29227 * c - 0.90649 * s), value + amplitude * 1.97294 * c};
}

double signal(float linear) {
    return renderer::optics::srgb_from_linear(std::clamp(static_cast<double>(linear), 0.0, 1.0));
}

} // namespace

void write_error_map(const std::filesystem::path& file, std::span<const float> values, int width,
                     int height) {
    std::array<std::array<std::uint8_t, 3>, 256> colors;
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const std::array<double, 3> color = cubehelix(static_cast<double>(i) / 255);
        std::transform(color.begin(), color.end(), colors[i].begin(), byte_of);
    }
    std::vector<std::uint8_t> rgb;
    rgb.reserve(3 * values.size());
    for (const float value : values) {
        const auto& color = colors[byte_of(static_cast<double>(value))];
        rgb.insert(rgb.end(), color.begin(), color.end());
    }
    write_png(file, rgb, width, height);
}

void write_difference(const std::filesystem::path& file, const Picture& image, const Picture& reference,
                      double gain) {
    std::vector<std::uint8_t> rgb(image.linear.size());
    std::transform(image.linear.begin(), image.linear.end(), reference.linear.begin(), rgb.begin(),
                   [&](float a, float b) { return byte_of(gain * std::abs(signal(a) - signal(b))); });
    write_png(file, rgb, image.width, image.height);
}

} // namespace measure
