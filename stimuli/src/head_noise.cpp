// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "head_noise.h"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include <support/random.h>

namespace stimuli::head {

Noise::Noise(std::string_view name, std::uint64_t seed) {
    std::vector<std::uint8_t> numbers(256);
    std::iota(numbers.begin(), numbers.end(), std::uint8_t{0});
    support::Generator generator(name, seed);
    generator.shuffle(numbers);
    for (std::size_t i = 0; i < shuffled_.size(); ++i) {
        shuffled_[i] = numbers[i % numbers.size()];
    }
}

namespace {

float between(float a, float b, float t) { return a + (b - a) * t; }

} // namespace

float Noise::operator()(glm::vec3 place) const {
    const glm::vec3 corner = glm::floor(place), t = place - corner;
    const glm::ivec3 cell = glm::ivec3(corner) & 255;
    const glm::vec3 ease = t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F);

    // Each lattice point pushes along one of the twelve directions from a cube's centre to its edges.
    const auto push = [&](int dx, int dy, int dz) {
        const auto hash = shuffled_[static_cast<std::size_t>(
            shuffled_[static_cast<std::size_t>(shuffled_[static_cast<std::size_t>((cell.x + dx) & 255)] +
                                               ((cell.y + dy) & 255))] +
            ((cell.z + dz) & 255))];
        const float x = t.x - static_cast<float>(dx), y = t.y - static_cast<float>(dy),
                    z = t.z - static_cast<float>(dz);
        const int edge = hash & 15;
        const float a = edge < 8 ? x : y;
        const float b = edge < 4 ? y : (edge == 12 || edge == 14 ? x : z);
        return ((edge & 1) != 0 ? -a : a) + ((edge & 2) != 0 ? -b : b);
    };
    const auto along_x = [&](int dy, int dz) { return between(push(0, dy, dz), push(1, dy, dz), ease.x); };
    const auto along_y = [&](int dz) { return between(along_x(0, dz), along_x(1, dz), ease.y); };
    return between(along_y(0), along_y(1), ease.z);
}

float Noise::octaves(glm::vec3 place, int count) const {
    float sum = 0, height = 1;
    for (int i = 0; i < count; ++i) {
        sum += height * (*this)(place);
        place = place * 2.03F + glm::vec3(17.3F, 5.1F, 29.7F);
        height *= 0.5F;
    }
    return sum;
}

} // namespace stimuli::head
