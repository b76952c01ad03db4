// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "skin.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/parallel_for.h>

#include <renderer/optics/specular.h>

namespace renderer::reference {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float smallest_slope = 0.02f; // material.glsl's
constexpr int cosines = 256;
constexpr int slope_rows = 65;

glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& other) {
    const float length = glm::length(v);
    return length > 1e-20f && std::isfinite(length) ? v / length : other;
}

/// x^p, 1 for p = 0; square roots are many and cheap.
float power(float x, float p) {
    if (p == 0.5f) {
        return std::sqrt(x);
    }
    return p <= 0 ? 1.0f : p == 1 ? x : std::pow(x, p);
}
glm::vec3 power(const glm::vec3& x, float p) { return {power(x.r, p), power(x.g, p), power(x.b, p)}; }

float slope_of(float roughness) { return std::max(roughness * roughness, smallest_slope); }

/// Kelemen/Szirmay-Kalos [DEonLuebke2007], as in lit.frag.
float kelemen_szirmay_kalos(const glm::vec3& N, const glm::vec3& L, const glm::vec3& V, float m, float f0) {
    const glm::vec3 h = L + V;
    const float hh = std::max(glm::dot(h, h), 1e-8f);
    const glm::vec3 H = h / std::sqrt(hh);
    const double NoH = std::max(static_cast<double>(glm::dot(N, H)), 1e-3);
    const double VoH = std::clamp(static_cast<double>(glm::dot(V, H)), 0.0, 1.0);
    const double lobe = optics::beckmann(std::min(NoH, 1.0), static_cast<double>(m)) *
                        optics::schlick(VoH, static_cast<double>(f0));
    return std::max(glm::dot(N, L), 0.0f) * static_cast<float>(lobe) / hh;
}

} // namespace

Skin::Skin(const Geometry& geometry, const scene::Look& look) : geometry_(geometry), look_(look) {
    for (const scene::Material& source : geometry.model().materials) {
        // A material that says nothing of its roughness has the look's slope, whose root is the roughness.
        Material material{{source.base_color, true, glm::vec4(1)},
                          {source.normal, false, glm::vec4(0.5f, 0.5f, 1, 1)},
                          {source.roughness, false, glm::vec4(1)},
                          {source.specular, false, glm::vec4(1)},
                          source.base_color_factor,
                          source.normal ? source.normal_scale : 0,
                          source.roughness_factor < 0 ? std::sqrt(look.roughness) : source.roughness_factor,
                          source.specular_factor,
                          source.double_sided,
                          {},
                          {}};
        tabulate_specular_albedo(material);
        materials_.push_back(std::move(material));
    }
}

void Skin::tabulate_specular_albedo(Material& material) const {
    // Where roughness does not vary one row holds it all.
    if (material.roughness.is_constant()) {
        material.slopes = {slope_of(material.roughness_factor)};
    } else {
        for (int i = 0; i < slope_rows; ++i) {
            const float share = static_cast<float>(i) / (slope_rows - 1);
            material.slopes.push_back(smallest_slope + (1 - smallest_slope) * share);
        }
    }
    material.specular_albedo.assign(material.slopes.size() * cosines, 0.0f);
    if (look_.specular_intensity == 0) {
        return;
    }
    tbb::parallel_for(std::size_t{0}, material.specular_albedo.size(), [&](std::size_t i) {
        const double cosine = static_cast<double>(i % cosines) / (cosines - 1);
        const auto m = static_cast<double>(std::min(material.slopes[i / cosines], 1.0f));
        material.specular_albedo[i] =
            static_cast<float>(optics::specular_albedo(cosine, m, static_cast<double>(look_.fresnel_f0)));
    });
}

float Skin::specular_albedo(const SkinPoint& point, float NoX) const {
    const Material& material = materials_[point.material];
    const float x = std::clamp(NoX, 0.0f, 1.0f) * (cosines - 1);
    const auto column = std::min(static_cast<std::size_t>(x), std::size_t{cosines - 2});
    const float across = x - static_cast<float>(column);
    const auto row_value = [&](std::size_t row) {
        const float* values = &material.specular_albedo[row * cosines + column];
        return values[0] + (values[1] - values[0]) * across;
    };
    if (material.slopes.size() == 1) {
        return row_value(0);
    }
    const float y =
        std::clamp((point.slope - smallest_slope) / (1 - smallest_slope), 0.0f, 1.0f) * (slope_rows - 1);
    const auto row = std::min(static_cast<std::size_t>(y), std::size_t{slope_rows - 2});
    return glm::mix(row_value(row), row_value(row + 1), y - static_cast<float>(row));
}

glm::vec3 Skin::mapped_normal(const Material& material, const glm::vec3& N, const glm::vec4& tangent,
                              const glm::vec2& uv) const {
    if (material.normal_scale == 0) {
        return N;
    }
    const glm::vec3 t(tangent);
    const glm::vec3 T = unit_or(t - N * glm::dot(N, t), glm::vec3(0));
    const glm::vec3 B = glm::cross(N, T) * tangent.w;
    const glm::vec3 n = glm::vec3(material.normal.at(uv)) * 2.0f - 1.0f;
    return unit_or((T * n.x + B * n.y) * material.normal_scale + N * n.z, N);
}

SkinPoint Skin::point(const Place& place, const glm::dvec3& eye_mm) const {
    const scene::Mesh& mesh = geometry_.mesh(place.id);
    const Material& material = materials_[mesh.material];
    const Corners corners = geometry_.corners(place.id);
    const scene::Vertex* vertices[3] = {&geometry_.vertex(place.id, 0), &geometry_.vertex(place.id, 1),
                                        &geometry_.vertex(place.id, 2)};
    const double weights[3] = {1 - place.weights.x - place.weights.y, place.weights.x, place.weights.y};
    SkinPoint point;
    point.material = mesh.material;
    point.position_mm = corners.at(place.weights);
    glm::vec3 normal(0);
    glm::vec4 tangent(0);
    glm::vec2 uv(0);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto w = static_cast<float>(weights[i]);
        normal += vertices[i]->normal * w;
        tangent += vertices[i]->tangent * w;
        uv += vertices[i]->uv * w;
    }
    const glm::dvec3 facet = corners.normal();
    const double side = material.double_sided && glm::dot(facet, eye_mm - point.position_mm) < 0 ? -1.0 : 1.0;
    point.normal = unit_or(normal, glm::vec3(facet)) * static_cast<float>(side);
    point.mapped = mapped_normal(material, point.normal, tangent, uv);
    point.color = material.base_color_factor * glm::vec3(material.base_color.at(uv));
    point.slope = slope_of(material.roughness_factor * material.roughness.at(uv).g);
    point.specular = look_.specular_intensity * material.specular_factor * material.specular.at(uv).a;

    // Lift the point to the tangent planes at the corners where the surface bulges, so that facets do not
    // shade themselves where the light turns away [Hanika2021].
    point.lifted_mm = point.position_mm + facet * (side * geometry_.epsilon_mm());
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 n = glm::dvec3(vertices[i]->normal) * side;
        const double below = glm::dot(point.position_mm - glm::dvec3(vertices[i]->position_mm), n);
        point.lifted_mm -= n * (weights[i] * std::min(below, 0.0));
    }
    return point;
}

Reached Skin::lit(const SkinPoint& point, const scene::Light& light) const {
    const auto reaches = [&](const scene::Beam& beam) {
        return glm::dot(point.normal, beam.direction) > 0 &&
               !geometry_.blocked({point.lifted_mm, beam.direction, geometry_.epsilon_mm(),
                                   std::numeric_limits<double>::infinity()});
    };
    Reached reached;
    reached[0] = reaches(light);
    for (std::size_t i = 0; i < light.further.size(); ++i) {
        reached[i + 1] = reaches(light.further[i]);
    }
    return reached;
}

glm::vec3 Skin::entering(const SkinPoint& point, const scene::Light& light, const Reached& reached) const {
    glm::vec3 irradiance = light.ambient_irradiance * (0.5f + 0.5f * point.mapped.y);
    const auto add = [&](const scene::Beam& beam, bool is_lit) {
        const float NoL = glm::dot(point.mapped, beam.direction);
        if (is_lit && NoL > 0) {
            const float transmitted = 1 - point.specular * specular_albedo(point, NoL);
            irradiance += beam.irradiance * (NoL * transmitted);
        }
    };
    add(light, reached[0]);
    for (std::size_t i = 0; i < light.further.size(); ++i) {
        add(light.further[i], reached[i + 1]);
    }
    return irradiance * power(point.color, look_.texture_mix) / pi;
}

glm::vec3 Skin::leaving(const SkinPoint& point, const glm::vec3& V) const {
    const float transmitted = 1 - point.specular * specular_albedo(point, glm::dot(point.mapped, V));
    return power(point.color, 1 - look_.texture_mix) * transmitted;
}

glm::vec3 Skin::reflected(const SkinPoint& point, const scene::Light& light, const glm::vec3& V,
                          const Reached& reached) const {
    if (reached.none() || look_.specular_intensity == 0) {
        return glm::vec3(0);
    }
    glm::vec3 sum(0);
    const auto add = [&](const scene::Beam& beam, bool is_lit) {
        if (is_lit) {
            const float lobe =
                kelemen_szirmay_kalos(point.mapped, beam.direction, V, point.slope, look_.fresnel_f0);
            sum += beam.irradiance * (point.specular * lobe / pi);
        }
    };
    add(light, reached[0]);
    for (std::size_t i = 0; i < light.further.size(); ++i) {
        add(light.further[i], reached[i + 1]);
    }
    return sum;
}

} // namespace renderer::reference
