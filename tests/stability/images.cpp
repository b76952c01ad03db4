// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "images.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>

#include <fmt/format.h>

namespace stability {

std::optional<renderer::gl::Context> RenderingTest::context;

namespace {

std::optional<std::uint64_t> number_from_environment(const char* name) {
    const char* text = std::getenv(name);
    return text && *text ? std::optional<std::uint64_t>(std::stoull(text)) : std::nullopt;
}

std::string place(const Frame& frame, std::size_t pixel) {
    const auto width = static_cast<std::size_t>(frame.width);
    return "pixel " + std::to_string(pixel % width) + ' ' + std::to_string(pixel / width);
}

/// Pixels near those whose coverage differs.
std::vector<bool> near_flips(const Frame& a, const Frame& b, std::size_t& flips, std::size_t& edges) {
    constexpr int reach = 2;
    std::vector<bool> marked(a.linear.size() / 4);
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const std::size_t alpha = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width) +
                                           static_cast<std::size_t>(x)) +
                                      3;
            edges += a.linear[alpha] > 0 && a.linear[alpha] < 1 ? 1 : 0;
            if (std::abs(a.linear[alpha] - b.linear[alpha]) < 1e-3f) {
                continue;
            }
            ++flips;
            for (int j = std::max(0, y - reach); j <= std::min(a.height - 1, y + reach); ++j) {
                for (int i = std::max(0, x - reach); i <= std::min(a.width - 1, x + reach); ++i) {
                    marked[static_cast<std::size_t>(j) * static_cast<std::size_t>(a.width) +
                           static_cast<std::size_t>(i)] = true;
                }
            }
        }
    }
    return marked;
}

/// What is displayed differs by more than a step of 255, or linear light by more than a 255th; else nothing.
std::string difference_at(const Frame& a, const Frame& b, std::size_t pixel) {
    for (std::size_t c = 0; c < 3; ++c) {
        const float p = a.linear[4 * pixel + c];
        const float q = b.linear[4 * pixel + c];
        const int steps = std::abs(int{a.srgb[3 * pixel + c]} - int{b.srgb[3 * pixel + c]});
        if (steps > 1 || !(std::abs(p - q) <= std::max(1.0f, std::abs(p)) / 255)) {
            return fmt::format("{} channel {}: {} and {}, displayed {} and {}; ", place(a, pixel), c, p, q,
                               a.srgb[3 * pixel + c], b.srgb[3 * pixel + c]);
        }
    }
    return {};
}

} // namespace

Indices indices(std::uint64_t everyday_count) {
    if (const auto only = number_from_environment("SKIN2AFC_STABILITY_ONLY")) {
        return {*only, *only + 1};
    }
    return {0, number_from_environment("SKIN2AFC_STABILITY_COUNT").value_or(everyday_count)};
}

Frame rendered(const Case& given, Shader shader) {
    renderer::passes::Pipeline pipeline(given.model, given.look, given.methods);
    return pipeline.render(shader, given.camera, given.light, true);
}

testing::AssertionResult is_sound(const Frame& frame) {
    for (std::size_t i = 0; i < frame.linear.size(); ++i) {
        if (!std::isfinite(frame.linear[i]) || frame.linear[i] < 0) {
            return testing::AssertionFailure()
                   << place(frame, i / 4) << " channel " << i % 4 << " is " << frame.linear[i];
        }
    }
    return testing::AssertionSuccess();
}

testing::AssertionResult is_same(const Frame& a, const Frame& b) {
    const bool same = a.srgb == b.srgb && a.linear.size() == b.linear.size() &&
                      std::memcmp(a.linear.data(), b.linear.data(), a.linear.size() * sizeof(float)) == 0;
    return same ? testing::AssertionSuccess() : testing::AssertionFailure() << "the images differ";
}

testing::AssertionResult is_alike(const Frame& a, const Frame& b, double outliers) {
    if (a.width != b.width || a.height != b.height) {
        return testing::AssertionFailure() << "the sizes differ";
    }
    std::size_t flips = 0;
    std::size_t edges = 0;
    const std::vector<bool> left_out = near_flips(a, b, flips, edges);
    if (flips > 2 + edges / 100) {
        return testing::AssertionFailure()
               << flips << " of " << edges << " pixels of the silhouette changed coverage";
    }
    std::string differences;
    std::size_t count = 0;
    for (std::size_t pixel = 0; pixel < left_out.size(); ++pixel) {
        const std::string difference = left_out[pixel] ? "" : difference_at(a, b, pixel);
        if (!difference.empty()) {
            differences += ++count < 4 ? difference : "";
        }
    }
    const double allowed = outliers > 0 ? 2 + outliers * static_cast<double>(left_out.size()) : 0;
    if (static_cast<double>(count) > allowed) {
        return testing::AssertionFailure() << count << " pixels differ: " << differences;
    }
    return testing::AssertionSuccess();
}

Frame flipped(const Frame& frame) {
    Frame result = frame;
    const auto width = static_cast<std::size_t>(frame.width);
    for (std::size_t pixel = 0; pixel < frame.linear.size() / 4; ++pixel) {
        const std::size_t other = pixel / width * width + (width - 1 - pixel % width);
        std::copy_n(&frame.linear[4 * pixel], 4, &result.linear[4 * other]);
        std::copy_n(&frame.srgb[3 * pixel], 3, &result.srgb[3 * other]);
    }
    return result;
}

} // namespace stability
