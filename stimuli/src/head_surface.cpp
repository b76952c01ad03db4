// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "head_surface.h"

#include <array>
#include <cstdint>
#include <numbers>
#include <utility>

#include <tbb/parallel_for.h>

#include "head_field.h"
#include "head_landmarks.h"

namespace stimuli::head {
namespace {

using renderer::scene::Mesh;

constexpr int columns = 228, rows = 131; // 59,280 triangles

/// Where the rays of one row start on the head's axis, and how steeply they rise in front and behind. The
/// rows fan out over the crown and below the chin, and lie nearly level elsewhere; no two rays meet before
/// the skin.
struct RayRow {
    float v;
    float start_y, start_z;
    float front_rise_deg, back_rise_deg;
};

constexpr std::array<RayRow, 14> ray_rows{{
    {0.000F, 44, -10, 90, 90},
    {0.055F, 43, -10, 48, 48},
    {0.100F, 40, -9, 20, 20},
    {0.160F, 30, -8, 4, 4},
    {0.330F, 3, -6, 0, 0},
    {0.480F, -11, -5, -18, -8},
    {0.595F, -26, -5, -23, -14},
    {0.735F, -58, -6, -26, -14},
    {0.835F, -84, -12, -36, -11},
    {0.895F, -118, -24, -20, -6},
    {0.925F, -158, -34, -6, -3},
    {0.965F, -222, -46, 4, 4},
    {0.985F, -246, -46, -2, -2},
    {1.000F, -247, -46, -90, -90},
}};

/// The row of rays at v: cubic Hermite pieces whose slopes do not overshoot [FritschButland1984].
RayRow ray_row_at(float v) {
    std::size_t i = 0;
    while (i + 2 < ray_rows.size() && v > ray_rows[i + 1].v) {
        ++i;
    }
    const auto at = [&](float RayRow::*field) {
        const auto secant = [&](std::size_t k) {
            return (ray_rows[k + 1].*field - ray_rows[k].*field) / (ray_rows[k + 1].v - ray_rows[k].v);
        };
        const auto slope = [&](std::size_t k) {
            if (k == 0 || k + 1 == ray_rows.size()) {
                return secant(k == 0 ? 0 : k - 1);
            }
            const float before = secant(k - 1), after = secant(k);
            return before * after > 0 ? 2 * before * after / (before + after) : 0.0F;
        };
        const float length = ray_rows[i + 1].v - ray_rows[i].v, t = (v - ray_rows[i].v) / length;
        const float t2 = t * t, t3 = t2 * t;
        return (2 * t3 - 3 * t2 + 1) * ray_rows[i].*field + (t3 - 2 * t2 + t) * length * slope(i) +
               (3 * t2 - 2 * t3) * ray_rows[i + 1].*field + (t3 - t2) * length * slope(i + 1);
    };
    return {v, at(&RayRow::start_y), at(&RayRow::start_z), at(&RayRow::front_rise_deg),
            at(&RayRow::back_rise_deg)};
}

/// How many columns a degree around the head deserves: many on the face, more at the ears, few behind.
float column_density(float azimuth_deg) {
    const float side = std::abs(azimuth_deg);
    return 0.20F + 1.07F * std::exp(-std::pow(side / 64, 4.0F)) + 0.45F * bell(side, 14) +
           0.62F * bell(side - 62, 18) + 1.2F * bell(side - 96, 14);
}

/// Azimuths of the columns in radians, from -pi to pi, 0 in front.
std::vector<float> column_azimuths() {
    // Integrate the density over fine steps and invert it.
    constexpr int steps = 7200;
    std::vector<double> sum(steps + 1, 0.0);
    for (int k = 0; k < steps; ++k) {
        const float middle_deg = -180 + 360 * (static_cast<float>(k) + 0.5F) / steps;
        sum[static_cast<std::size_t>(k) + 1] =
            sum[static_cast<std::size_t>(k)] + static_cast<double>(column_density(middle_deg));
    }
    std::vector<float> azimuths;
    std::size_t k = 0;
    for (int i = 0; i <= columns; ++i) {
        const double wanted = sum.back() * i / columns;
        while (k + 2 < sum.size() && sum[k + 1] < wanted) {
            ++k;
        }
        const double part = static_cast<double>(k) + (wanted - sum[k]) / (sum[k + 1] - sum[k]);
        azimuths.push_back(static_cast<float>(std::numbers::pi * (2 * part / steps - 1)));
    }
    return azimuths;
}

/// The outermost place on a ray where the field changes its sign.
glm::vec3 outermost_skin(const Person& person, glm::vec3 start, glm::vec3 direction) {
    // Walk in from outside in steps that cannot leap over a thin part, then halve the last step.
    float outside = 260, inside = 0;
    for (float at = outside; at > 0;) {
        const float distance = field(person, start + direction * at);
        if (distance < 0) {
            inside = at;
            break;
        }
        outside = at;
        at -= std::max(0.5F * distance, 0.4F);
    }
    for (int i = 0; i < 16; ++i) {
        const float middle = 0.5F * (inside + outside);
        (field(person, start + direction * middle) < 0 ? inside : outside) = middle;
    }
    return start + direction * (0.5F * (inside + outside));
}

/// Where the ray at a place between the grid's columns and rows meets the skin.
glm::vec3 traced(const Person& person, const std::vector<float>& azimuths, glm::vec2 ray) {
    const RayRow row = ray_row_at(ray.y / rows);
    const glm::vec3 start(0, row.start_y, row.start_z);
    if (ray.y <= 0 || ray.y >= rows) {
        return outermost_skin(person, start, {0, ray.y <= 0 ? 1 : -1, 0});
    }
    const auto left = static_cast<std::size_t>(std::min(static_cast<int>(ray.x), columns - 1));
    const float azimuth = glm::mix(azimuths[left], azimuths[left + 1], ray.x - static_cast<float>(left));
    const float front = 0.5F + 0.5F * std::cos(azimuth);
    const float rise = glm::radians(glm::mix(row.back_rise_deg, row.front_rise_deg, front));
    return outermost_skin(
        person, start,
        {std::cos(rise) * std::sin(azimuth), std::sin(rise), std::cos(rise) * std::cos(azimuth)});
}

/// Put the surface's places where the rays meet the skin; the last column is the first.
void trace(Surface& surface, const Person& person, const std::vector<float>& azimuths,
           const std::vector<glm::vec2>& rays) {
    surface.place_mm.resize(rays.size());
    tbb::parallel_for(0, rows + 1, [&](int j) {
        const auto first = static_cast<std::size_t>(j * (columns + 1));
        for (std::size_t i = 0; i < static_cast<std::size_t>(columns); ++i) {
            const bool pole = j == 0 || j == rows;
            surface.place_mm[first + i] =
                pole && i > 0 ? surface.place_mm[first] : traced(person, azimuths, rays[first + i]);
        }
        surface.place_mm[first + columns] = surface.place_mm[first];
    });
}

/// The surface between its places, at a ray between the grid's columns and rows.
glm::vec3 between(const Surface& surface, glm::vec2 ray) {
    const int i = std::clamp(static_cast<int>(ray.x), 0, columns - 1),
              j = std::clamp(static_cast<int>(ray.y), 0, rows - 1);
    const float right = ray.x - static_cast<float>(i), down = ray.y - static_cast<float>(j);
    return glm::mix(glm::mix(surface.at(i, j), surface.at(i + 1, j), right),
                    glm::mix(surface.at(i, j + 1), surface.at(i + 1, j + 1), right), down);
}

/// How hard the cells around a place pull together: harder on the nose, which would get too few of them.
float tightness(glm::vec3 place_mm) {
    const glm::vec3 rel = place_mm - glm::vec3(0, -34, 108);
    return 1 + 1.1F * std::exp(-glm::dot(rel, rel) / square(22));
}

/// Slide the face's rays along the skin towards the middle of their neighbours, so that cells become squares
/// of the map: a few steps down the energy whose least value a conformal map has. [PinkallPolthier1993]
void spread_evenly(std::vector<glm::vec2>& rays, const Surface& surface, const std::vector<float>& azimuths) {
    constexpr int steps = 450;
    constexpr float across = static_cast<float>(columns) / rows, down = 1 / across;
    std::vector<glm::vec3> places = surface.place_mm;
    for (int step = 0; step < steps; ++step) {
        std::vector<glm::vec2> moved = rays;
        for (int j = 2; j < rows - 1; ++j) {
            const float v = static_cast<float>(j) / rows;
            const float level = smooth_step(0.06F, 0.14F, v) * smooth_step(0.90F, 0.84F, v);
            for (int i = 1; i < columns; ++i) {
                const float side = std::abs(azimuths[static_cast<std::size_t>(i)]);
                const float free = 0.45F * level * smooth_step(1.56F, 1.28F, side);
                if (free <= 0) {
                    continue;
                }
                const auto k = static_cast<std::size_t>(j * (columns + 1) + i),
                           row = std::size_t{columns + 1};
                glm::vec3 middle(0);
                float sum = 0;
                for (const auto& [other, weight] :
                     {std::pair{k - 1, across}, {k + 1, across}, {k - row, down}, {k + row, down}}) {
                    const float tension = weight * (tightness(places[k]) + tightness(places[other]));
                    middle += tension * places[other];
                    sum += tension;
                }
                middle /= sum;
                const glm::vec3 pull = middle - places[k];
                const glm::vec3 right = between(surface, rays[k] + glm::vec2(0.5F, 0)) -
                                        between(surface, rays[k] - glm::vec2(0.5F, 0));
                const glm::vec3 below = between(surface, rays[k] + glm::vec2(0, 0.5F)) -
                                        between(surface, rays[k] - glm::vec2(0, 0.5F));
                const float rr = glm::dot(right, right), rb = glm::dot(right, below),
                            bb = glm::dot(below, below);
                const float r = glm::dot(pull, right), b = glm::dot(pull, below);
                const float area2 = std::max(rr * bb - rb * rb, 1e-3F * rr * bb);
                const glm::vec2 slide((r * bb - b * rb) / area2, (b * rr - r * rb) / area2);
                moved[k] += free * glm::clamp(slide, -0.25F, 0.25F);
            }
        }
        rays = std::move(moved);
        for (std::size_t k = 0; k < rays.size(); ++k) {
            places[k] = between(surface, rays[k]);
        }
    }
}

/// Move the ears' places towards the middle of their neighbours, a few times, so that the rims lose the steps
/// that the grid's columns cut into them.
void smooth_ears(Surface& surface, const std::vector<bool>& on_ear) {
    constexpr int passes = 5;
    for (int pass = 0; pass < passes; ++pass) {
        const Surface before = surface;
        for (int j = 1; j < surface.rows; ++j) {
            for (int i = 1; i < surface.columns; ++i) {
                const std::size_t k = static_cast<std::size_t>(j * (columns + 1) + i);
                if (on_ear[k]) {
                    surface.place_mm[k] =
                        0.5F * before.at(i, j) + 0.125F * (before.at(i - 1, j) + before.at(i + 1, j) +
                                                           before.at(i, j - 1) + before.at(i, j + 1));
                }
            }
        }
    }
}

/// Number of the vertex at a corner of the grid; the first row holds one vertex fewer than the others.
std::uint32_t vertex_index(const Surface& surface, int i, int j) {
    return static_cast<std::uint32_t>(j == 0 ? i : j * (surface.columns + 1) + i - 1);
}

/// Two triangles a cell, one at the poles.
void add_triangles(Mesh& mesh, const Surface& surface) {
    const auto index = [&](int i, int j) { return vertex_index(surface, i, j); };
    for (int j = 0; j < surface.rows; ++j) {
        for (int i = 0; i < surface.columns; ++i) {
            if (j + 1 < surface.rows) {
                mesh.indices.insert(mesh.indices.end(), {index(i, j), index(i, j + 1), index(i + 1, j + 1)});
            }
            if (j > 0) {
                const int below = j + 1 < surface.rows ? i + 1 : i;
                mesh.indices.insert(mesh.indices.end(), {index(i, j), index(below, j + 1), index(i + 1, j)});
            }
        }
    }
}

} // namespace

Surface head_surface(const Person& person) {
    const std::vector<float> azimuths = column_azimuths();
    Surface surface{columns, rows, {}};
    std::vector<glm::vec2> rays;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            rays.emplace_back(i, j);
        }
    }
    trace(surface, person, azimuths, rays);
    spread_evenly(rays, surface, azimuths);
    trace(surface, person, azimuths, rays);

    std::vector<bool> on_ear;
    for (glm::vec3& place : surface.place_mm) {
        const glm::vec3 skin = place;
        place = add_ear(skin);
        on_ear.push_back(place != skin);
    }
    smooth_ears(surface, on_ear);
    return surface;
}

renderer::scene::Mesh head_mesh(const Surface& surface) {
    Mesh mesh;
    mesh.has_uv = true;
    for (int j = 0; j <= surface.rows; ++j) {
        // A pole is one place with a vertex for each column, half way along its cell's edge.
        const bool pole = j == 0 || j == surface.rows;
        for (int i = 0; i < surface.columns + (pole ? 0 : 1); ++i) {
            renderer::scene::Vertex vertex;
            vertex.position_mm = surface.at(i, j);
            vertex.uv = {(static_cast<float>(i) + (pole ? 0.5F : 0.0F)) / static_cast<float>(surface.columns),
                         static_cast<float>(j) / static_cast<float>(surface.rows)};
            mesh.vertices.push_back(vertex);
        }
    }
    add_triangles(mesh, surface);
    renderer::scene::compute_normals(mesh);
    renderer::scene::compute_tangents(mesh);

    // Give both sides of the seam the same tangent.
    for (int j = 1; j < surface.rows; ++j) {
        auto &first = mesh.vertices[vertex_index(surface, 0, j)],
             &last = mesh.vertices[vertex_index(surface, surface.columns, j)];
        const glm::vec3 sum = glm::vec3(first.tangent) + glm::vec3(last.tangent);
        if (glm::length(sum) > 0.5F) {
            first.tangent = last.tangent = glm::vec4(glm::normalize(sum), first.tangent.w);
        }
    }
    return mesh;
}

} // namespace stimuli::head
