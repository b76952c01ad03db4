// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "cells.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>
#include <utility>

#include <tbb/parallel_for.h>

#include <support/error.h>

namespace renderer::reference {
namespace {

// A patch spans at most this many cells, so that spacing can follow the distance to what is visible.
constexpr double widest_patch = 16;
constexpr int deepest_split = 48;
// Longer triangles than this are halved: longest side squared over area; it is 2.3 if all sides are equal.
constexpr double longest_shape = 6;
constexpr std::size_t triangles_a_task = 256;
// Cells may grow to this multiple of what the plan asks: wider, they would not resolve their Gaussians.
constexpr double coarsest = 5;

/// A part of a triangle, by the weights of its corners there, to be cut into side^2 congruent cells.
struct Patch {
    TriangleId id;
    std::array<glm::dvec2, 3> corners;
    std::size_t side = 1;
};

/// How many cells all cutters have asked for, and how many they may.
struct Budget {
    std::size_t most = 0;
    std::atomic<std::size_t> spent{0};

    bool is_exceeded() const { return spent > most; }
};

class Cutter {
public:
    /// Cuts nothing more once the budget is exceeded.
    Cutter(const Geometry& geometry, const SamplingPlan& plan, double scale, Budget& budget,
           std::vector<Patch>& patches)
        : geometry_(geometry), plan_(plan), scale_(scale), budget_(budget), patches_(patches) {}

    void cut(TriangleId id) {
        corners_ = geometry_.corners(id);
        id_ = id;
        cut({glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)}, 0);
    }

private:
    void cut(const std::array<glm::dvec2, 3>& part, int depth) {
        const glm::dvec3 p[3] = {corners_.at(part[0]), corners_.at(part[1]), corners_.at(part[2])};
        const double area = 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
        if (!(area > 0) || budget_.is_exceeded()) {
            return;
        }
        std::size_t longest = 0; // the side that starts at this corner
        double lengths[3];
        for (std::size_t i = 0; i < 3; ++i) {
            lengths[i] = glm::length(p[(i + 1) % 3] - p[i]);
            longest = lengths[i] > lengths[longest] ? i : longest;
        }
        const glm::dvec3 centre = (p[0] + p[1] + p[2]) / 3.0;
        const double radius =
            std::max({glm::length(p[0] - centre), glm::length(p[1] - centre), glm::length(p[2] - centre)});
        const double spacing = scale_ * plan_.spacing_mm(centre, radius);
        if (spacing <= 0) {
            return;
        }
        const double length = lengths[longest];
        if (depth < deepest_split && length > spacing && length * length > longest_shape * area) {
            halve(part, longest, depth);
        } else if (depth < deepest_split && length > widest_patch * spacing) {
            quarter(part, depth);
        } else {
            const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(area) / spacing));
            budget_.spent += side * side;
            patches_.push_back({id_, part, side});
        }
    }

    void halve(const std::array<glm::dvec2, 3>& part, std::size_t longest, int depth) {
        const glm::dvec2& a = part[longest];
        const glm::dvec2& b = part[(longest + 1) % 3];
        const glm::dvec2& c = part[(longest + 2) % 3];
        const glm::dvec2 middle = 0.5 * (a + b);
        cut({a, middle, c}, depth + 1);
        cut({middle, b, c}, depth + 1);
    }

    void quarter(const std::array<glm::dvec2, 3>& part, int depth) {
        const glm::dvec2 ab = 0.5 * (part[0] + part[1]);
        const glm::dvec2 bc = 0.5 * (part[1] + part[2]);
        const glm::dvec2 ca = 0.5 * (part[2] + part[0]);
        cut({part[0], ab, ca}, depth + 1);
        cut({ab, part[1], bc}, depth + 1);
        cut({ca, bc, part[2]}, depth + 1);
        cut({bc, ca, ab}, depth + 1);
    }

    const Geometry& geometry_;
    const SamplingPlan& plan_;
    double scale_;
    Budget& budget_;
    std::vector<Patch>& patches_;
    TriangleId id_;
    Corners corners_;
};

/// Patches of at most `most` cells; none where that is too few.
std::optional<std::vector<Patch>> all_patches(const Geometry& geometry, const SamplingPlan& plan,
                                              double scale, std::size_t most) {
    std::vector<TriangleId> firsts; // of each task
    const auto& meshes = geometry.model().meshes;
    for (std::uint32_t m = 0; m < meshes.size(); ++m) {
        for (std::size_t t = 0; t < meshes[m].indices.size() / 3; t += triangles_a_task) {
            firsts.push_back({m, static_cast<std::uint32_t>(t)});
        }
    }
    Budget budget{most};
    std::vector<std::vector<Patch>> parts(firsts.size());
    tbb::parallel_for(std::size_t{0}, firsts.size(), [&](std::size_t i) {
        Cutter cutter(geometry, plan, scale, budget, parts[i]);
        const std::size_t count = geometry.mesh(firsts[i]).indices.size() / 3;
        const std::size_t last = std::min(firsts[i].triangle + triangles_a_task, count);
        for (std::size_t t = firsts[i].triangle; t < last; ++t) {
            cutter.cut({firsts[i].mesh, static_cast<std::uint32_t>(t)});
        }
    });
    if (budget.is_exceeded()) {
        return std::nullopt;
    }
    std::vector<Patch> patches;
    for (const std::vector<Patch>& part : parts) {
        patches.insert(patches.end(), part.begin(), part.end());
    }
    return patches;
}

/// Patches as the plan asks, or coarser ones if their cells would be too many.
std::vector<Patch> affordable_patches(const Geometry& geometry, const SamplingPlan& plan, std::size_t most) {
    std::size_t triangles = 0; // each is a cell at the least
    for (const scene::Mesh& mesh : geometry.model().meshes) {
        triangles += mesh.indices.size() / 3;
    }
    for (double scale = 1; scale <= coarsest; scale *= 1.2) {
        if (auto patches = all_patches(geometry, plan, scale, most + triangles)) {
            return std::move(*patches);
        }
    }
    throw support::input_error(
        "reference: surface cells: expected at most {}, found that the view needs more: a "
        "smaller image, wider Gaussians or a camera farther away need fewer",
        most);
}

/// Lights the cells of patches.
struct Lighting {
    const Geometry& geometry;
    const Skin& skin;
    const View& view;
    const scene::Light& light;

    /// One cell, from the weights of its corners: the mean over the centroids of its four quarters.
    Cell cell(const TriangleId& id, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) const {
        const Corners triangle = geometry.corners(id);
        const Corners p{triangle.at(a), triangle.at(b), triangle.at(c)};
        const glm::dvec2 quarters[4] = {(a + b + c) / 3.0, (4.0 * a + b + c) / 6.0, (a + 4.0 * b + c) / 6.0,
                                        (a + b + 4.0 * c) / 6.0};
        Cell cell;
        glm::dvec3 moment(0);
        double total = 0;
        for (const glm::dvec2& weights : quarters) {
            const SkinPoint point = skin.point({id, weights}, view.eye_mm());
            const glm::vec3 entering = skin.entering(point, light, skin.lit(point, light));
            cell.light += entering;
            const auto weight = static_cast<double>(entering.r + entering.g + entering.b);
            moment += point.position_mm * weight;
            total += weight;
        }
        if (!(total > 0) || !std::isfinite(total)) {
            return {};
        }
        cell.light *= static_cast<float>(0.5 * glm::length(p.cross()) / 4);
        cell.place_mm = glm::vec3(moment / total);
        // The covariance of a triangle's area is the sum of its sides' products over 36.
        for (const glm::dvec3& side : {p.b - p.a, p.c - p.b, p.a - p.c}) {
            cell.covariance.add(Covariance::of(glm::vec3(side)), 1 / 36.0f);
        }
        return cell;
    }

    void fill(const Patch& patch, Cell* cells) const {
        const auto n = static_cast<double>(patch.side);
        const auto corner = [&](std::size_t i, std::size_t j) {
            return patch.corners[0] + (patch.corners[1] - patch.corners[0]) * (static_cast<double>(i) / n) +
                   (patch.corners[2] - patch.corners[0]) * (static_cast<double>(j) / n);
        };
        for (std::size_t j = 0; j < patch.side; ++j) {
            for (std::size_t i = 0; i + j < patch.side; ++i) {
                *cells++ = cell(patch.id, corner(i, j), corner(i + 1, j), corner(i, j + 1));
                if (i + j + 1 < patch.side) {
                    *cells++ = cell(patch.id, corner(i + 1, j + 1), corner(i, j + 1), corner(i + 1, j));
                }
            }
        }
    }
};

} // namespace

std::vector<Cell> lit_cells(const Geometry& geometry, const Skin& skin, const View& view,
                            const scene::Light& light, const SamplingPlan& plan, std::size_t most) {
    const std::vector<Patch> patches = affordable_patches(geometry, plan, most);
    std::vector<std::size_t> firsts{0};
    for (const Patch& patch : patches) {
        firsts.push_back(firsts.back() + patch.side * patch.side);
    }
    std::vector<Cell> cells(firsts.back());
    const Lighting lighting{geometry, skin, view, light};
    tbb::parallel_for(std::size_t{0}, patches.size(),
                      [&](std::size_t i) { lighting.fill(patches[i], &cells[firsts[i]]); });
    std::erase_if(cells, [](const Cell& cell) { return !(cell.total() > 0); });
    return cells;
}

} // namespace renderer::reference
