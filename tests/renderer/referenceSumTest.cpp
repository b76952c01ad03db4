// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <support/random.h>

#include "light_tree.h"

namespace reference = renderer::reference;

namespace {

/// The sum that the octree is to stand for, term by term.
glm::dvec3 brute_force(const std::vector<reference::Cell>& cells, const glm::vec3& place, double variance) {
    glm::dvec3 sum{0};
    for (const reference::Cell& cell : cells) {
        const glm::dvec3 d = glm::dvec3(cell.place_mm) - glm::dvec3(place);
        sum += glm::dvec3(cell.light) *
               (std::exp(-glm::dot(d, d) / (2 * variance)) / (2 * std::numbers::pi * variance));
    }
    return sum;
}

glm::vec3 hierarchical(const reference::LightTree& tree, const glm::vec3& place, double variance) {
    const double sigma = std::sqrt(variance);
    reference::Box box;
    box.include(place);
    reference::Sources sources;
    tree.gather(tree.level_for(sigma), box, static_cast<float>(5 * sigma), sources);
    return sources.gaussian_sum(place, static_cast<float>(variance));
}

/// Cells of about 0.1 mm on a wavy sheet of 20 mm, with light that changes at random from one to the next and
/// steps down at x = 0.
std::vector<reference::Cell> wavy_sheet() {
    support::Generator random("wavy sheet", 1);
    const auto uniform = [&] { return static_cast<float>(random.uniform()); };
    std::vector<reference::Cell> cells;
    for (float x = -10; x < 10; x += 0.1f) {
        for (float y = -10; y < 10; y += 0.1f) {
            const glm::vec2 p(x + 0.05f * uniform(), y + 0.05f * uniform());
            const float light = (x < 0 ? 1.0f : 0.1f) * (0.5f + uniform());
            cells.push_back({{p.x, p.y, std::sin(p.x) + 0.5f * std::cos(2 * p.y)},
                             0.01f * light * glm::vec3(1, 0.5f, 0.25f),
                             {}});
        }
    }
    return cells;
}

} // namespace

TEST(ReferenceSumTest, agreesWithTheSumTermByTerm) {
    const std::vector<reference::Cell> cells = wavy_sheet();
    const reference::LightTree tree(cells, 0.1);
    support::Generator random("places", 1);
    for (const double sigma : {0.1, 0.22, 0.43, 0.75, 1.41, 2.72}) {
        double worst = 0;
        for (int i = 0; i < 300; ++i) {
            const reference::Cell& near = cells[random.below(cells.size())];
            const glm::vec3 place = near.place_mm + glm::vec3(0.03f, 0.02f, 0.01f);
            const glm::dvec3 expected = brute_force(cells, place, sigma * sigma);
            const glm::dvec3 found(hierarchical(tree, place, sigma * sigma));
            worst = std::max(worst, glm::length(found - expected) / glm::length(expected));
        }
        // Nodes are up to one standard deviation wide and keep three moments: what is left is of the fourth
        // order, (1/120) * 3/24 = 1e-3 of one node, less as they average out. The reach adds 4e-6.
        EXPECT_LT(worst, 1e-3) << sigma;
    }
}

TEST(ReferenceSumTest, oneCellGivesTheGaussianItself) {
    const reference::LightTree tree({{{1, 2, 3}, {1, 2, 4}, {}}}, 0.1);
    for (const double r : {0.0, 0.5, 1.0, 3.0}) {
        const double expected = std::exp(-r * r / 2) / (2 * std::numbers::pi);
        const glm::vec3 found = hierarchical(tree, {1, 2, 3 + static_cast<float>(r)}, 1);
        EXPECT_NEAR(static_cast<double>(found.r) / expected, 1, 2e-6) << r; // the exponential's stated error
        EXPECT_NEAR(static_cast<double>(found.b) / expected, 4, 8e-6) << r;
    }
}

TEST(ReferenceSumTest, anEmptySceneIsDark) {
    const reference::LightTree tree({}, 0.1);
    EXPECT_EQ(hierarchical(tree, {0, 0, 0}, 1), glm::vec3(0));
}
