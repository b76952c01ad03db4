// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "head_hair.h"

#include <support/random.h>

#include "head_landmarks.h"

namespace stimuli::head {
namespace {

// Squares of the half face that holds brows and lashes, for each side.
constexpr float low_x = 0, low_y = -18, bin_mm = 2;
constexpr int bins_x = 36, bins_y = 27;

int bin_of(int x, int y, float side) { return ((side < 0 ? 1 : 0) * bins_y + y) * bins_x + x; }

float distance_to(const std::array<glm::vec2, 4>& line, glm::vec2 p, float& along) {
    float nearest = 1e9F;
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
        const glm::vec2 edge = line[k + 1] - line[k], rel = p - line[k];
        const float t = std::clamp(glm::dot(rel, edge) / glm::dot(edge, edge), 0.0F, 1.0F);
        const float distance = glm::length(rel - edge * t);
        if (distance < nearest) {
            nearest = distance;
            along = (static_cast<float>(k) + t) / 3;
        }
    }
    return nearest;
}

/// A hair that leaves its root at one angle and bends to another.
std::array<glm::vec2, 4> bent(glm::vec2 root, float angle, float end_angle, float length_mm) {
    std::array<glm::vec2, 4> line{root};
    for (std::size_t k = 1; k < line.size(); ++k) {
        const float turn = glm::mix(angle, end_angle, (static_cast<float>(k) - 0.5F) / 3);
        line[k] = line[k - 1] + length_mm / 3 * glm::vec2(std::cos(turn), std::sin(turn));
    }
    return line;
}

} // namespace

Hairs::Hairs(const Person& person) : bins_(static_cast<std::size_t>(2 * bins_x * bins_y)) {
    for (const float side : {-1.0F, 1.0F}) {
        add_brow(person, side);
        add_lashes(person, side);
    }
}

void Hairs::add(const Hair& hair, float side) {
    const int number = static_cast<int>(hairs_.size());
    hairs_.push_back(hair);
    glm::vec2 low = hair.line[0], high = low;
    for (const glm::vec2 p : hair.line) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    constexpr float reach_mm = 0.6F; // as far as a hair's blurred edge is seen
    const auto square_of = [](float at, float from, int count) {
        return std::clamp(static_cast<int>((at - from) / bin_mm), 0, count - 1);
    };
    for (int y = square_of(low.y - reach_mm, low_y, bins_y); y <= square_of(high.y + reach_mm, low_y, bins_y);
         ++y) {
        for (int x = square_of(low.x - reach_mm, low_x, bins_x);
             x <= square_of(high.x + reach_mm, low_x, bins_x); ++x) {
            bins_[static_cast<std::size_t>(bin_of(x, y, side))].push_back(number);
        }
    }
}

void Hairs::add_brow(const Person& person, float side) {
    // Hairs stand up at the inner end and lie down along the brow farther out; those above lean down, those
    // below up.
    support::Generator generator(side < 0 ? "right brow" : "left brow", person.seed);
    const auto any = [&] { return static_cast<float>(generator.uniform()); };
    const int count = static_cast<int>(820 * (1 - 0.3F * std::clamp(person.age - 0.6F, 0.0F, 1.0F)));
    for (int i = 0; i < count; ++i) {
        const float s = std::pow(any(), 0.80F), across = any() + any() + any() - 1.5F;
        const float half_height = glm::mix(5.2F, 3.2F, std::pow(s, 0.9F)) * smooth_step(-0.25F, 0.18F, s);
        if (any() < 0.6F * smooth_step(0.75F, 1.1F, s)) {
            continue;
        }
        const float x = 11.0F + 45 * s;
        const glm::vec2 root(x, brow_y(x) + across * half_height - 0.8F);
        const float lean = across * (s < 0.2F ? 0.25F : 0.38F);
        const float angle = glm::mix(1.45F, 0.12F, std::pow(smooth_step(-0.1F, 0.6F, s), 0.6F)) - lean -
                            0.25F * s + 0.7F * (any() - 0.5F);
        const float length =
            glm::mix(4.0F, 6.5F, arch(std::min(s * 0.8F + 0.1F, 1.0F))) * (0.5F + 0.6F * any());
        add({bent(root, angle, angle - 0.5F * (1 - s) - 0.15F, length), 0.028F + 0.040F * any(),
             any() < 0.85F * person.grey},
            side);
    }
}

void Hairs::add_lashes(const Person& person, float side) {
    support::Generator generator(side < 0 ? "right lashes" : "left lashes", person.seed);
    const auto any = [&] { return static_cast<float>(generator.uniform()); };
    constexpr int count = 60;
    for (int i = 0; i < count; ++i) {
        const float s = 0.05F + 0.97F * (static_cast<float>(i) + any()) / count;
        const float x = eye_inner_x + s * (eye_outer_x - eye_inner_x);
        const float length = (1.6F + 3.6F * smooth_step(0.0F, 0.7F, s)) * (0.7F + 0.4F * any());
        const float down = -1.57F + 1.0F * (s - 0.3F) + 0.35F * (any() - 0.5F);
        add({bent({x, lid_line_y(x) + 0.1F}, down, down + 0.5F * (s - 0.1F), length), 0.045F + 0.03F * any(),
             false},
            side);
    }
}

Hairs::Cover Hairs::cover(glm::vec3 folded, float side, float spot_mm) const {
    const glm::vec2 p(folded.x, folded.y);
    const int x = static_cast<int>((p.x - low_x) / bin_mm),
              y = static_cast<int>(std::floor((p.y - low_y) / bin_mm));
    if (folded.z < 28 || x < 0 || x >= bins_x || y < 0 || y >= bins_y) {
        return {0, 0};
    }
    float clear = 1, grey = 0;
    for (const int number : bins_[static_cast<std::size_t>(bin_of(x, y, side))]) {
        const Hair& hair = hairs_[static_cast<std::size_t>(number)];
        float along = 0;
        const float distance = distance_to(hair.line, p, along);
        // A hair finer than the spot covers a part of it.
        const float radius = hair.radius_mm * (1 - 0.75F * along * along),
                    seen = std::max(radius, 0.4F * spot_mm);
        const float share = std::min(radius / seen, 1.0F) * smooth_step(1.6F * seen, 0.5F * seen, distance);
        grey = glm::mix(grey, hair.grey ? 1.0F : 0.0F, share);
        clear *= 1 - share;
    }
    return {1 - clear, grey};
}

} // namespace stimuli::head
