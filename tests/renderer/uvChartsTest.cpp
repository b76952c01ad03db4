// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include "uv_charts.h"

namespace passes = renderer::passes;
namespace scene = renderer::scene;

TEST(UvChartsTest, trianglesThatShareACornerAreOneChart) {
    scene::Mesh mesh;
    const auto vertex = [](float x, float u) { return scene::Vertex{{x, 0, 0}, {}, {}, {u, 0}}; };
    // Triangles 0 and 1 meet in two vertices of one place and UV; triangle 2 has the place, but another UV.
    mesh.vertices = {vertex(0, 0),    vertex(1, 0.1f), vertex(2, 0.2f), vertex(2, 0.2f), vertex(3, 0.3f),
                     vertex(4, 0.4f), vertex(4, 0.8f), vertex(5, 0.9f), vertex(6, 1.0f)};
    mesh.indices = {0, 1, 2, 3, 4, 5, 6, 7, 8};
    EXPECT_EQ(passes::chart_of_triangle(mesh), (std::vector<std::uint32_t>{0, 0, 1}));
}

TEST(UvChartsTest, growsByTheReachAndNoFurther) {
    constexpr int size = 16;
    std::vector<bool> covered(size * size);
    covered[5 * size + 6] = true;
    const auto nearest = passes::nearest_covered(covered, size, 3);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const bool within = std::abs(x - 6) <= 3 && std::abs(y - 5) <= 3;
            const passes::Texel texel = nearest[static_cast<std::size_t>(y * size + x)];
            EXPECT_EQ(texel.x, within ? 6 : -1);
            EXPECT_EQ(texel.y, within ? 5 : -1);
        }
    }
}
