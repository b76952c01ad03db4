// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <renderer/reference/reference.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include <tbb/parallel_for.h>

#include <support/error.h>

#include "cells.h"
#include "finish.h"
#include "light_tree.h"
#include "sampling_plan.h"
#include "scattering.h"

namespace renderer::reference {
namespace {

constexpr int tile_px = 4;    // hits of a tile share the sources of their light
constexpr int band_tiles = 8; // rows of tiles between two reports of progress

// Shares of the time, roughly, for the progress.
constexpr double plan_share = 0.1, cells_share = 0.4;

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void require(bool condition, const char* what, const char* expected) {
    if (!condition) {
        throw support::input_error("reference: {}: expected {}", what, expected);
    }
}

void check(const Settings& settings, const scene::Look& look, const scene::Model& model) {
    require(settings.samples_per_side >= 1 && settings.samples_per_side <= 64, "samples_per_side", "1 to 64");
    require(settings.cells_per_sigma >= 0.25 && settings.cells_per_sigma <= 8, "cells_per_sigma", ".25 to 8");
    require(settings.most_cells >= 1000 && settings.most_cells <= 500'000'000, "most_cells", "1e3 to 5e8");
    require(!look.profile.gaussians.empty(), "profile", "at least one Gaussian");
    for (const optics::Gaussian& g : look.profile.gaussians) {
        require(std::isfinite(g.variance_mm2) && g.variance_mm2 >= 0 && finite(glm::vec3(g.weight)),
                "profile", "finite, non-negative variances and finite weights");
    }
    require(!(look.aperture_mm > 0), "lens", "an aperture of 0, all sharp");
    bool any = false;
    for (const scene::Mesh& mesh : model.meshes) {
        any = any || mesh.indices.size() >= 3;
        require(model.materials[mesh.material].scatters, "model", "materials that scatter");
    }
    require(any, "model", "at least one triangle");
}

void check(const scene::Camera& camera, const scene::Light& light) {
    require(camera.width >= 1 && camera.height >= 1, "image", "at least one pixel");
    require(finite(camera.eye_mm) && finite(camera.target_mm) && camera.eye_mm != camera.target_mm, "camera",
            "finite places, eye and target apart");
    require(camera.fov_rad > 0 && camera.fov_rad < 3.1415f, "field of view", "0 to 180 degrees");
    require(light.further.size() < scene::most_beams, "light", "at most 8 beams");
    for (const scene::Beam& beam : light.beams()) {
        require(finite(beam.direction) && std::abs(glm::length(beam.direction) - 1) < 1e-3f,
                "light direction", "a unit vector");
        require(finite(beam.irradiance) && finite(light.ambient_irradiance), "light", "finite irradiance");
    }
}

} // namespace

struct Reference::State {
    scene::Look look;
    Settings settings;
    Geometry geometry;
    Skin skin;
    std::vector<glm::dvec2> pattern;
    StageSeconds seconds;

    State(const scene::Model& model, const scene::Look& look_, const Settings& settings_)
        : look(look_), settings(settings_), geometry(model), skin(geometry, look),
          pattern(pixel_pattern(settings.samples_per_side)) {}

    template <typename Work>
    auto timed(const char* stage, const Work& work) {
        const auto start = std::chrono::steady_clock::now();
        auto result = work();
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        seconds[stage] += elapsed.count();
        return result;
    }

    /// What the rays of a square of pixels meet, pixel by pixel.
    std::vector<Hit> hits(const View& view, const scene::Light& light, const glm::ivec2& corner) const {
        std::vector<Hit> result;
        for (int y = corner.y; y < std::min(corner.y + tile_px, view.height()); ++y) {
            for (int x = corner.x; x < std::min(corner.x + tile_px, view.width()); ++x) {
                for (const glm::dvec2& offset : pattern) {
                    const auto place = geometry.nearest(view.ray(glm::dvec2(x, y) + offset));
                    if (!place) {
                        continue;
                    }
                    Hit hit;
                    hit.place = *place;
                    hit.point = skin.point(*place, view.eye_mm());
                    hit.reached = skin.lit(hit.point, light);
                    hit.entering = skin.entering(hit.point, light, hit.reached);
                    hit.footprint_mm = view.footprint_mm(view.depth_mm(hit.point.position_mm));
                    hit.pixel = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(view.width()) +
                                static_cast<std::uint32_t>(x);
                    result.push_back(hit);
                }
            }
        }
        return result;
    }

    /// Average the samples of each pixel of a tile.
    void shade(const View& view, const scene::Light& light, const Scattering& scattering,
               const glm::ivec2& corner, Picture& picture) const {
        const std::vector<Hit> tile = hits(view, light, corner);
        const std::vector<glm::vec3> scattered = scattering.scattered(tile);
        const auto width = static_cast<std::uint32_t>(view.width());
        const auto pixel = [&](std::uint32_t number) -> glm::vec4& {
            return picture.at(static_cast<int>(number % width),
                              view.height() - 1 - static_cast<int>(number / width));
        };
        for (std::size_t i = 0; i < tile.size(); ++i) {
            const Hit& hit = tile[i];
            const glm::vec3 V(glm::normalize(view.eye_mm() - hit.point.position_mm));
            const glm::vec3 light_out =
                scattered[i] * skin.leaving(hit.point, V) + skin.reflected(hit.point, light, V, hit.reached);
            pixel(hit.pixel) += glm::vec4(finite(light_out) ? light_out : glm::vec3(0), 1);
        }
        const auto count = static_cast<float>(pattern.size());
        for (int y = corner.y; y < std::min(corner.y + tile_px, view.height()); ++y) {
            for (int x = corner.x; x < std::min(corner.x + tile_px, view.width()); ++x) {
                picture.at(x, view.height() - 1 - y) /= count;
            }
        }
    }
};

Reference::Reference(const scene::Model& model, const scene::Look& look, const Settings& settings) {
    check(settings, look, model);
    state_ = std::make_unique<State>(model, look, settings);
}

Reference::~Reference() = default;

scene::Frame Reference::render(const scene::Camera& camera, const scene::Light& light, bool with_linear,
                               const Progress& progress) {
    check(camera, light);
    State& s = *state_;
    const auto report = [&](double share) {
        if (progress) {
            progress(share);
        }
    };
    const View view(camera, s.geometry);
    const SamplingPlan plan = s.timed("reference visible surface", [&] {
        return SamplingPlan(s.geometry, view, s.pattern, s.look.profile, s.settings.cells_per_sigma);
    });
    report(plan_share);
    std::vector<Cell> cells = s.timed("reference entering light", [&] {
        return lit_cells(s.geometry, s.skin, view, light, plan, s.settings.most_cells);
    });
    report(cells_share);
    const LightTree tree =
        s.timed("reference octree", [&] { return LightTree(std::move(cells), plan.narrowest_sigma_mm()); });
    const Scattering scattering(s.geometry, s.skin, view, light, s.look.profile, tree, s.pattern.size());
    const Picture picture = s.timed("reference scattering", [&] {
        Picture result(camera.width, camera.height);
        const int columns = (camera.width + tile_px - 1) / tile_px;
        const int rows = (camera.height + tile_px - 1) / tile_px;
        for (int band = 0; band < rows; band += band_tiles) {
            const int count = std::min(band_tiles, rows - band) * columns;
            tbb::parallel_for(0, count, [&](int i) {
                s.shade(view, light, scattering, {i % columns * tile_px, (band + i / columns) * tile_px},
                        result);
            });
            report(cells_share + (1 - cells_share) * (band + band_tiles) / (rows + band_tiles));
        }
        return result;
    });
    return s.timed("reference output", [&] { return finished(picture, s.look, with_linear); });
}

const StageSeconds& Reference::seconds() const { return state_->seconds; }

} // namespace renderer::reference
