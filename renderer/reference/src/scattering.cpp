// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "scattering.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <support/random.h>

namespace renderer::reference {
namespace {

// Hits within this many standard deviations share a sum.
constexpr double shared_sigmas = 0.5;
// Gaussians narrower than this share of a pixel are taken as points.
constexpr double point_px = 0.1;
// Pixels take their random numbers from one of so many lists.
constexpr std::uint64_t spread_count = 256;

bool is_narrow(double sigma_mm, const Hit& hit) { return sigma_mm < narrow_px * hit.footprint_mm; }

/// Where the hits of the pixel that starts at `first` end.
std::size_t pixel_end(std::span<const Hit> hits, std::size_t first) {
    std::size_t last = first;
    while (last < hits.size() && hits[last].pixel == hits[first].pixel) {
        ++last;
    }
    return last;
}

} // namespace

Scattering::Scattering(const Geometry& geometry, const Skin& skin, const View& view,
                       const scene::Light& light, const optics::Profile& profile, const LightTree& tree,
                       std::size_t samples)
    : geometry_(geometry), skin_(skin), view_(view), light_(light), profile_(profile), tree_(tree) {
    // A lattice of the golden ratio, shifted and in an order that has nothing to do with places in the pixel.
    for (std::uint64_t k = 0; k < spread_count; ++k) {
        support::Generator random("reference scattering", k);
        const glm::dvec2 shift(random.uniform(), random.uniform());
        std::vector<glm::dvec2> spread;
        for (std::size_t i = 0; i < samples; ++i) {
            const auto number = static_cast<double>(i);
            spread.push_back(glm::fract(
                shift + glm::dvec2(number / static_cast<double>(samples), number / std::numbers::phi)));
        }
        random.shuffle(spread);
        spreads_.push_back(std::move(spread));
    }
}

std::vector<glm::vec3> Scattering::scattered(std::span<const Hit> hits) const {
    std::vector<glm::vec3> result(hits.size(), glm::vec3(0));
    double footprint_mm = 0;
    for (const Hit& hit : hits) {
        footprint_mm = std::max(footprint_mm, hit.footprint_mm);
    }
    for (const optics::Gaussian& gaussian : profile_.gaussians) {
        std::vector<Query> wide = queries(hits, std::sqrt(gaussian.variance_mm2));
        sum_over_cells(wide, gaussian, footprint_mm, result);
        sample_around(hits, gaussian, result);
    }
    return result;
}

std::vector<Scattering::Query> Scattering::queries(std::span<const Hit> hits, double sigma_mm) const {
    std::vector<Query> result;
    for (std::size_t first = 0; first < hits.size();) {
        const std::size_t last = pixel_end(hits, first);
        add_queries_of_pixel(hits, first, last, sigma_mm, result);
        first = last;
    }
    return result;
}

void Scattering::add_queries_of_pixel(std::span<const Hit> hits, std::size_t first, std::size_t last,
                                      double sigma_mm, std::vector<Query>& queries) const {
    const double reach = shared_sigmas * sigma_mm;
    std::vector<bool> taken(last - first, false);
    // Begin in the pixel's middle, so that one query serves all if it can.
    for (std::size_t k = 0; k < last - first; ++k) {
        const std::size_t seed = first + (k + (last - first) / 2) % (last - first);
        if (taken[seed - first] || is_narrow(sigma_mm, hits[seed])) {
            continue;
        }
        Query query;
        glm::dvec3 sum(0);
        double squares = 0;
        for (std::size_t i = first; i < last; ++i) {
            const glm::dvec3 d = hits[i].point.position_mm - hits[seed].point.position_mm;
            const double square = glm::dot(d, d);
            if (!taken[i - first] && square <= reach * reach && !is_narrow(sigma_mm, hits[i])) {
                taken[i - first] = true;
                query.hits.push_back(static_cast<std::uint32_t>(i));
                sum += d;
                squares += square;
            }
        }
        const auto count = static_cast<double>(std::max<std::size_t>(query.hits.size(), 1));
        const glm::dvec3 mean = sum / count;
        query.place_mm = glm::vec3(hits[seed].point.position_mm + mean);
        query.variance_mm2 =
            static_cast<float>(std::max(0.5 * (squares / count - glm::dot(mean, mean)), 0.0));
        queries.push_back(std::move(query));
    }
}

void Scattering::sum_over_cells(std::vector<Query>& queries, const optics::Gaussian& gaussian,
                                double footprint_mm, std::vector<glm::vec3>& result) const {
    const double sigma_mm = std::sqrt(gaussian.variance_mm2);
    const std::size_t level = tree_.level_for(sigma_mm);
    const auto reach_mm = static_cast<float>(reach_sigmas * sigma_mm);
    const auto together = static_cast<float>(std::max(3 * sigma_mm, 6 * footprint_mm));
    static thread_local Sources sources;
    while (!queries.empty()) {
        // Those near the first share their sources.
        const glm::vec3 seed = queries.front().place_mm;
        const auto rest = std::stable_partition(queries.begin(), queries.end(), [&](const Query& query) {
            return glm::distance(query.place_mm, seed) > together;
        });
        Box box;
        for (auto query = rest; query != queries.end(); ++query) {
            box.include(query->place_mm);
        }
        tree_.gather(level, box, reach_mm, sources);
        for (auto query = rest; query != queries.end(); ++query) {
            const glm::vec3 value =
                glm::vec3(gaussian.weight) *
                sources.gaussian_sum(query->place_mm,
                                     static_cast<float>(gaussian.variance_mm2) + query->variance_mm2);
            for (const std::uint32_t hit : query->hits) {
                result[hit] += value;
            }
        }
        queries.erase(rest, queries.end());
    }
}

void Scattering::sample_around(std::span<const Hit> hits, const optics::Gaussian& gaussian,
                               std::vector<glm::vec3>& result) const {
    const double sigma_mm = std::sqrt(gaussian.variance_mm2);
    const glm::vec3 weight(gaussian.weight);
    for (std::size_t first = 0; first < hits.size();) {
        const std::size_t last = pixel_end(hits, first);
        const std::uint32_t scrambled = hits[first].pixel * 2654435761u; // 2^32 over the golden ratio
        const std::vector<glm::dvec2>& spread = spreads_[(scrambled >> 16) % spreads_.size()];
        for (std::size_t i = first; i < last; ++i) {
            const Hit& hit = hits[i];
            if (sigma_mm < point_px * hit.footprint_mm) {
                result[i] += weight * hit.entering;
            } else if (is_narrow(sigma_mm, hit)) {
                result[i] += weight * entering_beside(hit, sigma_mm, spread[i - first]);
            }
        }
        first = last;
    }
}

glm::vec3 Scattering::entering_beside(const Hit& hit, double sigma_mm, const glm::dvec2& random) const {
    // Step aside in the triangle's plane, as far as the Gaussian says.
    const Corners corners = geometry_.corners(hit.place.id);
    const glm::dvec3 normal = corners.normal();
    const glm::dvec3 along = glm::normalize(corners.b - corners.a);
    const double radius = sigma_mm * std::sqrt(-2 * std::log(1 - random.x));
    const double angle = 2 * std::numbers::pi * random.y;
    const glm::dvec3 p = hit.point.position_mm +
                         radius * (std::cos(angle) * along + std::sin(angle) * glm::cross(normal, along));

    // Most often that is in the same triangle; else look for the surface from above.
    const glm::dvec3 cross = corners.cross();
    const double scale = glm::dot(cross, cross);
    Place place{hit.place.id,
                {glm::dot(glm::cross(p - corners.a, corners.c - corners.a), cross) / scale,
                 glm::dot(glm::cross(corners.b - corners.a, p - corners.a), cross) / scale}};
    if (place.weights.x < 0 || place.weights.y < 0 || place.weights.x + place.weights.y > 1) {
        const double height = reach_sigmas * sigma_mm + geometry_.epsilon_mm();
        const auto found = geometry_.nearest({p + normal * height, -normal, 0, 2 * height});
        if (!found) {
            return glm::vec3(0);
        }
        place = *found;
    }
    const SkinPoint point = skin_.point(place, view_.eye_mm());
    return skin_.entering(point, light_, skin_.lit(point, light_));
}

} // namespace renderer::reference
