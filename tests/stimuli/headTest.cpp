// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <head_crossing.h>
#include <head_surface.h>

#include "head_under_test.h"

namespace {

using renderer::scene::Mesh;
using renderer::scene::Model;
using renderer::scene::Vertex;
using stimuli::HeadDetail;
using stimuli::head::crossing;

/// The mesh with vertices at the same place made one.
struct Welded {
    std::vector<glm::vec3> places;
    std::vector<std::array<std::size_t, 3>> triangles;
};

Welded weld(const Mesh& mesh) {
    Welded result;
    std::map<glm::vec3, std::size_t, PlaceOrder> numbers;
    std::vector<std::size_t> number_of;
    for (const Vertex& vertex : mesh.vertices) {
        const auto [entry, added] = numbers.emplace(vertex.position_mm, result.places.size());
        if (added) {
            result.places.push_back(vertex.position_mm);
        }
        number_of.push_back(entry->second);
    }
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        result.triangles.push_back(
            {number_of[mesh.indices[i]], number_of[mesh.indices[i + 1]], number_of[mesh.indices[i + 2]]});
    }
    return result;
}

/// How many corners have a normal that points into their triangle.
int turned_in(const Mesh& mesh) {
    int count = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const Vertex &a = mesh.vertices[mesh.indices[i]], &b = mesh.vertices[mesh.indices[i + 1]],
                     &c = mesh.vertices[mesh.indices[i + 2]];
        const glm::vec3 normal = glm::cross(b.position_mm - a.position_mm, c.position_mm - a.position_mm);
        for (const Vertex* corner : {&a, &b, &c}) {
            count += glm::dot(normal, corner->normal) > 0 ? 0 : 1;
        }
    }
    return count;
}

TEST(HeadTest, isAClosedSurfaceWithoutHandles) {
    const Welded welded = weld(mesh());
    std::set<std::pair<std::size_t, std::size_t>> edges;
    for (const auto& triangle : welded.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t from = triangle[k], to = triangle[(k + 1) % 3];
            ASSERT_NE(from, to) << "degenerate triangle";
            ASSERT_TRUE(edges.emplace(from, to).second) << "two triangles run along an edge the same way";
        }
    }
    for (const auto& [from, to] : edges) {
        ASSERT_TRUE(edges.count({to, from}) == 1) << "open edge at y = " << welded.places[from].y << " mm";
    }
    // Euler: V - E + F = 2 for a sphere.
    const auto vertices = static_cast<long>(welded.places.size());
    const auto faces = static_cast<long>(welded.triangles.size());
    EXPECT_EQ(vertices - static_cast<long>(edges.size()) / 2 + faces, 2);
}

TEST(HeadTest, hasAsManyTrianglesAsPromised) {
    EXPECT_GE(mesh().indices.size() / 3, 20000U);
    EXPECT_LE(mesh().indices.size() / 3, 60000U);
}

TEST(HeadTest, hasTheSizeOfAnAdultHead) {
    // The chin is the lowest place in front: no part of the neck or chest reaches 60 mm ahead of the axis.
    float vertex_y = -1000, chin_y = 1000, half_width = 0, front = -1000, back = 1000;
    for (const Vertex& vertex : mesh().vertices) {
        const glm::vec3& p = vertex.position_mm;
        vertex_y = std::max(vertex_y, p.y);
        chin_y = p.z > 60 ? std::min(chin_y, p.y) : chin_y;
        half_width = p.y > 30 ? std::max(half_width, std::abs(p.x)) : half_width;
        front = p.y > 8 && p.y < 35 ? std::max(front, p.z) : front;
        back = p.y > 0 ? std::min(back, p.z) : back;
    }
    // The lowest vertex misses the chin's lowest point by up to the sagitta of a 2 mm cell on a 10 mm radius,
    // 0.05 mm.
    EXPECT_NEAR(vertex_y - chin_y, 232, 0.2);
    EXPECT_NEAR(vertex_y + chin_y, 0, 0.2) << "the eyes, at y = 0, are half way";
    // The project's canon of proportions; 2 % is less than people differ, and more than the asymmetry.
    EXPECT_NEAR(2 * half_width, 152, 3);
    EXPECT_NEAR(front - back, 197, 3.5);
}

TEST(HeadTest, turnsItsSurfaceOutwards) {
    double volume_mm3 = 0;
    for (std::size_t i = 0; i < mesh().indices.size(); i += 3) {
        const Vertex &a = mesh().vertices[mesh().indices[i]], &b = mesh().vertices[mesh().indices[i + 1]],
                     &c = mesh().vertices[mesh().indices[i + 2]];
        const glm::vec3 normal = glm::cross(b.position_mm - a.position_mm, c.position_mm - a.position_mm);
        volume_mm3 +=
            static_cast<double>(glm::dot(a.position_mm, glm::cross(b.position_mm, c.position_mm))) / 6;
        for (const Vertex* corner : {&a, &b, &c}) {
            ASSERT_GT(glm::dot(normal, corner->normal), 0)
                << corner->position_mm.x << ' ' << corner->position_mm.y << ' ' << corner->position_mm.z;
            // Single precision: a few units in the last place.
            ASSERT_NEAR(glm::length(corner->normal), 1, 1e-5);
        }
    }
    // More than an adult's head alone, about 4 litres, and less than the box around the bust.
    const renderer::scene::Bounds box = renderer::scene::bounds(head());
    const glm::dvec3 size(box.high - box.low);
    EXPECT_GT(volume_mm3, 4e6);
    EXPECT_LT(volume_mm3, size.x * size.y * size.z);
}

TEST(HeadTest, doesNotPassThroughItself) { EXPECT_EQ(crossing(mesh()), std::nullopt); }

/// A head's shape without its maps.
Model shape(std::uint64_t seed, double age_years) {
    stimuli::HeadSettings settings;
    settings.seed = seed;
    settings.age_years = age_years;
    Model model;
    model.meshes.push_back(
        stimuli::head::head_mesh(stimuli::head::head_surface(stimuli::head::Person(settings))));
    return model;
}

TEST(HeadCrossingTest, tellsThroughFromBeside) {
    // Two tetrahedra, the second shifted by a share of the first's size: at 0.4 they pass through each other,
    // at 1 they touch in a corner, at 1.5 they stand apart.
    for (const auto& [shift, through] : {std::pair{0.4F, true}, {1.0F, false}, {1.5F, false}}) {
        Mesh mesh;
        for (const float x : {0.0F, 10 * shift}) {
            const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
            for (const glm::vec3 corner : {glm::vec3(0), {10, 0, 0}, {0, 10, 0}, {0, 0, 10}}) {
                mesh.vertices.emplace_back().position_mm =
                    corner + glm::vec3(x, 0.3F * x * (shift < 1 ? 1 : 0), 0);
            }
            for (const std::uint32_t k : {0U, 2U, 1U, 0U, 1U, 3U, 0U, 3U, 2U, 1U, 2U, 3U}) {
                mesh.indices.push_back(first + k);
            }
        }
        EXPECT_EQ(crossing(mesh).has_value(), through) << shift;
    }
}

TEST(HeadTest, keepsItsFormForOtherPeopleAgesAndLevels) {
    for (const auto& [seed, age_years] : {std::pair{1U, 20.0}, {2U, 80.0}, {3U, 45.0}}) {
        const Model person = shape(seed, age_years);
        for (const HeadDetail detail : {HeadDetail::full, HeadDetail::fifth, HeadDetail::tenth}) {
            const Mesh mesh = stimuli::simplified(person, detail).meshes.front();
            const auto place = crossing(mesh);
            EXPECT_FALSE(place) << "seed " << seed << ", age " << age_years << ", " << mesh.indices.size() / 3
                                << " triangles: " << place->x << ' ' << place->y << ' ' << place->z;
        }
        EXPECT_EQ(turned_in(person.meshes.front()), 0) << "seed " << seed << ", age " << age_years;
    }
}

TEST(HeadTest, unfoldsWithoutOverlap) {
    constexpr int size = 1024;
    std::vector<int> covered(static_cast<std::size_t>(size) * size, 0);
    for (std::size_t i = 0; i < mesh().indices.size(); i += 3) {
        std::array<glm::dvec2, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec2 uv = mesh().vertices[mesh().indices[i + k]].uv;
            ASSERT_TRUE(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1) << uv.x << ' ' << uv.y;
            corners[k] = glm::dvec2(uv) * static_cast<double>(size);
        }
        // Count the texel centres strictly inside; one on an edge belongs to no triangle, so it cannot be
        // counted twice.
        const glm::dvec2 low = glm::min(glm::min(corners[0], corners[1]), corners[2]);
        const glm::dvec2 high = glm::max(glm::max(corners[0], corners[1]), corners[2]);
        for (int y = static_cast<int>(low.y); y < std::min(size, static_cast<int>(high.y) + 1); ++y) {
            for (int x = static_cast<int>(low.x); x < std::min(size, static_cast<int>(high.x) + 1); ++x) {
                const glm::dvec2 centre(x + 0.5, y + 0.5);
                int left = 0, right = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    const glm::dvec2 edge = corners[(k + 1) % 3] - corners[k], rel = centre - corners[k];
                    const double side = edge.x * rel.y - edge.y * rel.x;
                    left += side > 1e-9 ? 1 : 0;
                    right += side < -1e-9 ? 1 : 0;
                }
                covered[static_cast<std::size_t>(y * size + x)] += left == 3 || right == 3 ? 1 : 0;
            }
        }
    }
    EXPECT_LE(*std::max_element(covered.begin(), covered.end()), 1);
    // Texel centres on edges are rare; the poles leave half of two rows of cells, 1.5 % of the square.
    EXPECT_GT(std::count(covered.begin(), covered.end(), 1), size * size * 95 / 100);
}

TEST(HeadTest, spendsItsTexelsOnTheFace) {
    // The face (from the front, brows to chin, as wide as the cheekbones) is a tenth of the surface.
    double face_uv = 0, all_uv = 0, face_mm2 = 0, all_mm2 = 0;
    for (std::size_t i = 0; i < mesh().indices.size(); i += 3) {
        const Vertex &a = mesh().vertices[mesh().indices[i]], &b = mesh().vertices[mesh().indices[i + 1]],
                     &c = mesh().vertices[mesh().indices[i + 2]];
        const glm::vec2 s = b.uv - a.uv, t = c.uv - a.uv;
        const double uv = static_cast<double>(std::abs(s.x * t.y - s.y * t.x)) / 2;
        const double mm2 = static_cast<double>(glm::length(
                               glm::cross(b.position_mm - a.position_mm, c.position_mm - a.position_mm))) /
                           2;
        const bool face = a.position_mm.z > 30 && a.position_mm.y > -115 && a.position_mm.y < 30;
        face_uv += face ? uv : 0;
        face_mm2 += face ? mm2 : 0;
        all_uv += uv;
        all_mm2 += mm2;
    }
    EXPECT_GT(face_uv / face_mm2, 2 * all_uv / all_mm2);
}

TEST(HeadTest, stretchesTheFaceLittleInItsMap) {
    // Singular values of the map from the square to the skin, over the whole face: forehead to chin, as wide
    // as the cheekbones, with what hangs over.
    double all_mm2 = 0, even_mm2 = 0;
    for (std::size_t i = 0; i < mesh().indices.size(); i += 3) {
        const Vertex &a = mesh().vertices[mesh().indices[i]], &b = mesh().vertices[mesh().indices[i + 1]],
                     &c = mesh().vertices[mesh().indices[i + 2]];
        const glm::dvec3 p(b.position_mm - a.position_mm), q(c.position_mm - a.position_mm);
        const glm::dvec3 cross = glm::cross(p, q);
        const glm::vec3& at = a.position_mm;
        const bool face = at.z > 45 && std::abs(at.x) < 60 && at.y > -112 && at.y < 60;
        if (!face) {
            continue;
        }
        const glm::dvec2 s(b.uv - a.uv), t(c.uv - a.uv);
        const double determinant = s.x * t.y - t.x * s.y;
        const glm::dvec3 u = (p * t.y - q * s.y) / determinant, v = (q * s.x - p * t.x) / determinant;
        const double half_sum = (glm::dot(u, u) + glm::dot(v, v)) / 2;
        const double spread = std::hypot((glm::dot(u, u) - glm::dot(v, v)) / 2, glm::dot(u, v));
        const double mm2 = glm::length(cross) / 2;
        all_mm2 += mm2;
        even_mm2 += half_sum + spread < 4 * (half_sum - spread) ? mm2 : 0;
    }
    // What is left are spots beside the nose and its wings.
    EXPECT_GT(even_mm2, 0.99 * all_mm2);
}

TEST(HeadTest, isTheSameEveryTime) {
    const Model again = stimuli::sculpt_head({});
    EXPECT_EQ(again.digest, head().digest);
    EXPECT_EQ(again.digest.size(), 64U);
    EXPECT_EQ(again.materials.front().base_color->pixels, head().materials.front().base_color->pixels);
}

} // namespace
