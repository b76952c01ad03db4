// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "finish.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include <renderer/optics/color.h>

namespace renderer::reference {
namespace {

/// Bilinear, at a place in pixels whose whole numbers are centres.
glm::vec4 interpolated(const Picture& source, float x, float y) {
    const int i = static_cast<int>(std::floor(x));
    const int j = static_cast<int>(std::floor(y));
    const float u = x - std::floor(x);
    const float v = y - std::floor(y);
    return glm::mix(glm::mix(source.clamped(i, j), source.clamped(i + 1, j), u),
                    glm::mix(source.clamped(i, j + 1), source.clamped(i + 1, j + 1), u), v);
}

/// The picture at another size.
Picture resized(const Picture& source, int width, int height) {
    Picture result(width, height);
    const float x_scale = static_cast<float>(source.width) / static_cast<float>(width);
    const float y_scale = static_cast<float>(source.height) / static_cast<float>(height);
    tbb::parallel_for(0, height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            result.at(x, y) = interpolated(source, (static_cast<float>(x) + 0.5f) * x_scale - 0.5f,
                                           (static_cast<float>(y) + 0.5f) * y_scale - 0.5f);
        }
    });
    return result;
}

/// One 1D Gaussian along `axis`. The shader takes its taps in pairs, so that their number to each side is
/// even.
Picture blurred(const Picture& source, const glm::ivec2& axis, float sigma_px) {
    const int reach = static_cast<int>(std::ceil(3 * sigma_px));
    std::vector<float> weights{1};
    float total = 1;
    for (int i = 1; i <= reach + reach % 2; ++i) {
        weights.push_back(std::exp(-0.5f * static_cast<float>(i * i) / (sigma_px * sigma_px)));
        total += 2 * weights.back();
    }
    Picture result(source.width, source.height);
    tbb::parallel_for(0, source.height, [&](int y) {
        for (int x = 0; x < source.width; ++x) {
            glm::vec4 sum = source.at(x, y);
            for (int i = 1; i < static_cast<int>(weights.size()); ++i) {
                sum +=
                    weights[static_cast<std::size_t>(i)] * (source.clamped(x + i * axis.x, y + i * axis.y) +
                                                            source.clamped(x - i * axis.x, y - i * axis.y));
            }
            result.at(x, y) = sum / total;
        }
    });
    return result;
}

std::uint8_t encoded(float linear) {
    const double signal = optics::srgb_from_linear(std::clamp(static_cast<double>(linear), 0.0, 1.0));
    return static_cast<std::uint8_t>(std::lround(255 * signal));
}

Picture bloomed(const Picture& picture, const scene::Look& look) {
    if (look.bloom_strength <= 0 || look.bloom_sigma_px <= 0) {
        return picture;
    }
    const float sigma_px = std::max(0.5f * look.bloom_sigma_px, 1e-3f);
    const Picture half = resized(picture, (picture.width + 1) / 2, (picture.height + 1) / 2);
    Picture result =
        resized(blurred(blurred(half, {1, 0}, sigma_px), {0, 1}, sigma_px), picture.width, picture.height);
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        result.pixels[i] = glm::mix(picture.pixels[i], result.pixels[i], look.bloom_strength);
    }
    return result;
}

} // namespace

scene::Frame finished(const Picture& picture, const scene::Look& look, bool with_linear) {
    const Picture glowing = bloomed(picture, look);
    scene::Frame frame;
    frame.width = picture.width;
    frame.height = picture.height;
    frame.srgb.resize(3 * picture.pixels.size());
    frame.linear.resize(with_linear ? 4 * picture.pixels.size() : 0);
    tbb::parallel_for(0, picture.height, [&](int row) {
        const int y = picture.height - 1 - row;
        std::size_t i = static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width);
        for (int x = 0; x < picture.width; ++x, ++i) {
            const glm::vec4& color = glowing.at(x, y);
            const glm::vec3 light = (glm::vec3(color) + look.background * (1 - color.a)) * look.exposure;
            for (glm::length_t c = 0; c < 3; ++c) {
                frame.srgb[3 * i + static_cast<std::size_t>(c)] = encoded(light[c]);
            }
            for (glm::length_t c = 0; with_linear && c < 4; ++c) {
                frame.linear[4 * i + static_cast<std::size_t>(c)] = c < 3 ? light[c] : picture.at(x, y).a;
            }
        }
    });
    return frame;
}

} // namespace renderer::reference
