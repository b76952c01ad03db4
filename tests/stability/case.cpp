// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "case.h"

#include <cmath>
#include <utility>

namespace stability {
namespace {

/// Change every vertex, and the camera's two places.
template <typename Place, typename Direction>
void transform(Case& given, const Place& place, const Direction& direction) {
    for (renderer::scene::Mesh& mesh : given.model.meshes) {
        for (renderer::scene::Vertex& vertex : mesh.vertices) {
            vertex.position_mm = place(vertex.position_mm);
            vertex.normal = direction(vertex.normal);
            vertex.tangent = glm::vec4(direction(glm::vec3(vertex.tangent)), vertex.tangent.w);
        }
    }
    given.camera.eye_mm = place(given.camera.eye_mm);
    given.camera.target_mm = place(given.camera.target_mm);
    given.light.direction = direction(given.light.direction);
    for (renderer::scene::Beam& beam : given.light.further) {
        beam.direction = direction(beam.direction);
    }
}

} // namespace

Case scaled(Case given, double factor) {
    transform(
        given, [=](const glm::vec3& p) { return glm::vec3(glm::dvec3(p) * factor); },
        [](const glm::vec3& d) { return d; });
    for (renderer::optics::Gaussian& g : given.look.profile.gaussians) {
        g.variance_mm2 *= factor * factor;
    }
    const auto f = static_cast<float>(factor);
    given.light.shadow_softness_mm *= f;
    given.methods.jittered.unit_mm *= f;
    return given;
}

Case mirrored(Case given) {
    const auto mirror = [](const glm::vec3& p) { return glm::vec3(-p.x, p.y, p.z); };
    transform(given, mirror, mirror);
    for (renderer::scene::Mesh& mesh : given.model.meshes) {
        for (renderer::scene::Vertex& vertex : mesh.vertices) {
            vertex.tangent.w = -vertex.tangent.w;
        }
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
        }
    }
    return given;
}

Case turned(Case given, double angle_rad) {
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    const auto turn = [=](const glm::vec3& p) {
        const glm::dvec3 d(p);
        return glm::vec3(glm::dvec3(c * d.x + s * d.z, d.y, c * d.z - s * d.x));
    };
    transform(given, turn, turn);
    return given;
}

Case moved(Case given, const glm::dvec3& by_mm) {
    transform(
        given, [&](const glm::vec3& p) { return glm::vec3(glm::dvec3(p) + by_mm); },
        [](const glm::vec3& d) { return d; });
    return given;
}

Case brightened(Case given, double factor) {
    const auto f = static_cast<float>(factor);
    given.light.irradiance *= f;
    given.light.ambient_irradiance *= f;
    for (renderer::scene::Beam& beam : given.light.further) {
        beam.irradiance *= f;
    }
    given.look.background *= f;
    given.look.exposure /= f;
    return given;
}

renderer::optics::Profile gaussian(double sigma_mm) {
    return {"gaussian", {{sigma_mm * sigma_mm, glm::dvec3(1)}}};
}

} // namespace stability
