// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "soundness.h"

#include <algorithm>
#include <cmath>

#include <support/error.h>

namespace measure {

namespace scene = renderer::scene;

void check_same(const scene::Frame& first, const scene::Frame& second, bool empty, const std::string& name) {
    if (!std::all_of(first.linear.begin(), first.linear.end(), [](float v) { return std::isfinite(v); })) {
        throw support::failure("{}: expected finite light everywhere, found other values", name);
    }
    if (first.linear != second.linear || first.srgb != second.srgb) {
        throw support::failure("{}: expected the same frame twice, found two that differ", name);
    }
    bool covered = false;
    for (std::size_t i = 3; i < first.linear.size(); i += 4) {
        covered = covered || first.linear[i] > 0;
    }
    if (covered == empty) {
        throw support::failure("{}: expected {} in view, found {}", name, empty ? "nothing" : "something",
                               empty ? "something" : "nothing");
    }
}

void check_hidden(const scene::Frame& first, const scene::Frame& other, const std::string& name) {
    if (first.linear != other.linear) {
        throw support::failure(
            "{}: expected all heads to be hidden, found a frame that another shader changes", name);
    }
}

long long covered_pixels(const scene::Frame& frame) {
    long long pixels = 0;
    for (std::size_t i = 3; i < frame.linear.size(); i += 4) {
        pixels += frame.linear[i] > 0 ? 1 : 0;
    }
    return pixels;
}

} // namespace measure
