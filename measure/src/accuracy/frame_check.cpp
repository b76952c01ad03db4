// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "frame_check.h"

#include <algorithm>
#include <cmath>

#include <support/error.h>

namespace measure {
namespace {

// A pixel that one image covers wholly and the other not at all is no matter of antialiasing; so many may be,
// as a share of the object, for thin parts of a model.
constexpr double most_miscovered = 0.002;

} // namespace

Picture picture_of(const renderer::scene::Frame& frame, const std::string& name) {
    Picture picture{name, frame.width, frame.height, {}, {}};
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
        picture.linear.insert(picture.linear.end(), &frame.linear[4 * i], &frame.linear[4 * i + 3]);
        picture.coverage.push_back(frame.linear[4 * i + 3]);
    }
    return picture;
}

void check_sound(const Picture& image, const Picture& truth) {
    const auto finite = [](float value) { return std::isfinite(value); };
    if (!std::all_of(image.linear.begin(), image.linear.end(), finite) ||
        !std::all_of(image.coverage.begin(), image.coverage.end(), finite)) {
        throw support::failure("{}: expected finite light everywhere, found other values", image.name);
    }
    std::size_t object = 0, miscovered = 0;
    for (std::size_t i = 0; i < truth.coverage.size(); ++i) {
        object += truth.coverage[i] > 0 ? 1 : 0;
        miscovered += std::abs(truth.coverage[i] - image.coverage[i]) > 0.999f ? 1 : 0;
    }
    if (static_cast<double>(miscovered) > most_miscovered * static_cast<double>(object)) {
        throw support::failure(
            "{}: expected the reference's silhouette, found {} of {} pixels on its wrong side", image.name,
            miscovered, object);
    }
}

} // namespace measure
