// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "sampling_plan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

namespace renderer::reference {
namespace {

constexpr std::int64_t most_voxels = 8'000'000;
constexpr float nothing_visible = 1e9f;

bool before(const glm::ivec3& a, const glm::ivec3& b) {
    return std::array{a.z, a.y, a.x} < std::array{b.z, b.y, b.x};
}

void make_unique(std::vector<glm::ivec3>& voxels) {
    std::sort(voxels.begin(), voxels.end(), before);
    voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
}

} // namespace

SamplingPlan::SamplingPlan(const Geometry& geometry, const View& view, const std::vector<glm::dvec2>& pattern,
                           const optics::Profile& profile, double cells_per_sigma)
    : view_(view), cells_per_sigma_(cells_per_sigma), origin_mm_(geometry.bounds().low) {
    for (const optics::Gaussian& g : profile.gaussians) {
        if (g.variance_mm2 > 0) {
            sigmas_mm_.push_back(std::sqrt(g.variance_mm2));
        }
    }
    std::sort(sigmas_mm_.begin(), sigmas_mm_.end());
    if (sigmas_mm_.empty()) {
        return;
    }
    // Voxels an eighth of the widest Gaussian's reach, unless the model is so large that their numbers would
    // overflow.
    reach_mm_ = reach_sigmas * sigmas_mm_.back();
    const glm::dvec3 extent(geometry.bounds().high - geometry.bounds().low);
    const double largest_mm = std::max({extent.x, extent.y, extent.z, geometry.epsilon_mm()});
    voxel_mm_ = std::max(std::min(reach_mm_, largest_mm) / 8, largest_mm * 1e-6);
    find_visible(geometry, pattern);
    if (!visible_.empty()) {
        find_distances();
    }
}

void SamplingPlan::find_visible(const Geometry& geometry, const std::vector<glm::dvec2>& pattern) {
    std::vector<std::vector<glm::ivec3>> rows(static_cast<std::size_t>(view_.height()));
    tbb::parallel_for(0, view_.height(), [&](int y) {
        std::vector<glm::ivec3>& voxels = rows[static_cast<std::size_t>(y)];
        for (int x = 0; x < view_.width(); ++x) {
            for (const glm::dvec2& offset : pattern) {
                const auto place = geometry.nearest(view_.ray(glm::dvec2(x, y) + offset));
                if (!place) {
                    continue;
                }
                const glm::dvec3 p = geometry.corners(place->id).at(place->weights) - origin_mm_;
                const glm::ivec3 voxel(glm::floor(p / voxel_mm_));
                if (voxels.empty() || voxels.back() != voxel) {
                    voxels.push_back(voxel);
                }
            }
        }
        make_unique(voxels);
    });
    for (const auto& voxels : rows) {
        visible_.insert(visible_.end(), voxels.begin(), voxels.end());
    }
    make_unique(visible_);
}

void SamplingPlan::find_distances() {
    // Lay a dense grid around what is visible, with the reach to all sides; double its voxels until it is
    // small enough.
    for (;;) {
        glm::ivec3 high = visible_.front();
        low_ = high;
        for (const glm::ivec3& voxel : visible_) {
            low_ = glm::min(low_, voxel);
            high = glm::max(high, voxel);
        }
        margin_ = static_cast<int>(std::ceil(std::min(reach_mm_ / voxel_mm_, 8.0))) + 2;
        low_ -= margin_;
        size_ = high + margin_ + 1 - low_;
        if (std::int64_t{size_.x} * size_.y * size_.z <= most_voxels) {
            break;
        }
        voxel_mm_ *= 2;
        for (glm::ivec3& voxel : visible_) {
            voxel /= 2; // none is negative
        }
        make_unique(visible_);
    }
    // The squared Euclidean distance splits into one minimum along each axis [FelzenszwalbHuttenlocher2012].
    distances_.assign(index({0, 0, size_.z}), nothing_visible);
    for (const glm::ivec3& voxel : visible_) {
        distances_[index(voxel - low_)] = 0;
    }
    for (int axis = 0; axis < 3; ++axis) {
        spread(axis);
    }
}

void SamplingPlan::spread(int axis) {
    const std::vector<float> source = distances_;
    tbb::parallel_for(0, size_.z, [&](int z) {
        for (int y = 0; y < size_.y; ++y) {
            for (int x = 0; x < size_.x; ++x) {
                const glm::ivec3 voxel(x, y, z);
                float nearest = nothing_visible;
                for (int k = std::max(-margin_, -voxel[axis]);
                     k <= std::min(margin_, size_[axis] - 1 - voxel[axis]); ++k) {
                    glm::ivec3 other = voxel;
                    other[axis] += k;
                    nearest = std::min(nearest, source[index(other)] + static_cast<float>(k * k));
                }
                distances_[index(voxel)] = nearest;
            }
        }
    });
}

double SamplingPlan::distance_mm(const glm::dvec3& place_mm) const {
    const glm::dvec3 place = glm::floor((place_mm - origin_mm_) / voxel_mm_) - glm::dvec3(low_);
    const glm::dvec3 inside = glm::clamp(place, glm::dvec3(0), glm::dvec3(size_ - 1));
    // Both places lie anywhere in their voxels. Beyond the margin the grid knows no distances, and outside it
    // the way leads through its nearest voxel.
    const double outside = glm::length(place - inside);
    const double centres = std::min(std::sqrt(static_cast<double>(distances_[index(glm::ivec3(inside))])),
                                    static_cast<double>(margin_));
    return std::max(std::max(centres, outside) - std::sqrt(3.0), 0.0) * voxel_mm_;
}

double SamplingPlan::spacing_mm(const glm::dvec3& centre_mm, double radius_mm) const {
    if (visible_.empty()) {
        return 0;
    }
    // The narrowest Gaussian that carries light from here to a visible place, and there is wide enough to be
    // summed over cells.
    const double distance = std::max(distance_mm(centre_mm) - radius_mm, 0.0);
    const double depth = view_.depth_mm(centre_mm);
    for (const double sigma : sigmas_mm_) {
        const double reach = reach_sigmas * sigma;
        const double least_depth = std::max(depth - radius_mm - reach, view_.near_mm());
        if (reach >= distance && sigma >= narrow_px * view_.footprint_mm(least_depth)) {
            return sigma / cells_per_sigma_;
        }
    }
    return 0;
}

} // namespace renderer::reference
