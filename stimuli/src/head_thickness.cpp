// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "head_thickness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <embree3/rtcore.h>
#include <tbb/parallel_for.h>

#include <support/error.h>

namespace stimuli::head {
namespace {

using renderer::scene::Mesh;
using renderer::scene::Vertex;

using Device = std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)>;
using Scene = std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)>;

constexpr int directions = 48;

/// The mesh as Embree knows it; buffers belong to the scene.
Scene scene_of(RTCDevice device, const Mesh& mesh) {
    Scene scene(rtcNewScene(device), &rtcReleaseScene);
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* places = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
    auto* corners = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.indices.size() / 3));
    if (!places || !corners) {
        throw support::failure("thickness: Embree: no memory");
    }
    for (const Vertex& vertex : mesh.vertices) {
        places = std::copy(&vertex.position_mm.x, &vertex.position_mm.x + 3, places);
    }
    std::copy(mesh.indices.begin(), mesh.indices.end(), corners);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    return scene;
}

/// Directions within 60 degrees of -z, evenly spread over the solid angle, along a spiral.
std::array<glm::vec3, directions> inward_cone() {
    std::array<glm::vec3, directions> cone{};
    for (int i = 0; i < directions; ++i) {
        const float t = (static_cast<float>(i) + 0.5F) / directions, z = 1 - 0.5F * t;
        const float turn = static_cast<float>(i) * std::numbers::pi_v<float> * (3 - std::sqrt(5.0F));
        const float radius = std::sqrt(1 - z * z);
        cone[static_cast<std::size_t>(i)] = {radius * std::cos(turn), radius * std::sin(turn), -z};
    }
    return cone;
}

float way_through(RTCScene scene, glm::vec3 from, glm::vec3 direction) {
    RTCRayHit ray{};
    ray.ray.org_x = from.x;
    ray.ray.org_y = from.y;
    ray.ray.org_z = from.z;
    ray.ray.dir_x = direction.x;
    ray.ray.dir_y = direction.y;
    ray.ray.dir_z = direction.z;
    ray.ray.tnear = 0;
    ray.ray.tfar = most_thickness_mm;
    ray.ray.mask = ~0U;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray);
    return ray.ray.tfar;
}

} // namespace

std::vector<float> thickness_mm(const Mesh& mesh) {
    const Device device(rtcNewDevice(nullptr), &rtcReleaseDevice);
    if (!device) {
        throw support::failure("thickness: Embree cannot start (error {})",
                               static_cast<int>(rtcGetDeviceError(nullptr)));
    }
    const Scene scene = scene_of(device.get(), mesh);
    const auto cone = inward_cone();
    std::vector<float> thickness(mesh.vertices.size());
    tbb::parallel_for(std::size_t{0}, thickness.size(), [&](std::size_t i) {
        const Vertex& vertex = mesh.vertices[i];
        const glm::vec3 normal = vertex.normal, along(vertex.tangent), across = glm::cross(normal, along);
        // Start a little below the skin, so that the triangles around the vertex are not met.
        constexpr float lift_mm = 0.1F;
        float sum = 0;
        for (const glm::vec3& d : cone) {
            const glm::vec3 inward = d.x * along + d.y * across + d.z * normal;
            sum += 1 / (lift_mm + way_through(scene.get(), vertex.position_mm - lift_mm * normal, inward));
        }
        thickness[i] = std::min(directions / sum, most_thickness_mm);
    });
    return thickness;
}

renderer::scene::Image thickness_map(const Mesh& mesh) {
    // Fill each triangle's texels; those that two share get the same value from both.
    constexpr int size = 512;
    const std::vector<float> thickness = thickness_mm(mesh);
    renderer::scene::Image image{size, size, 3, std::vector<std::uint8_t>(std::size_t{3} * size * size)};
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        std::array<glm::vec2, 3> at{};
        glm::vec3 value(0);
        for (std::size_t k = 0; k < 3; ++k) {
            at[k] = mesh.vertices[mesh.indices[i + k]].uv * static_cast<float>(size) - 0.5F;
            value[static_cast<int>(k)] = thickness[mesh.indices[i + k]];
        }
        const glm::vec2 u = at[1] - at[0], v = at[2] - at[0];
        const float area = u.x * v.y - u.y * v.x;
        // Reach one texel over the edge, so that the poles' empty corners are filled, too.
        const glm::vec2 low = glm::min(glm::min(at[0], at[1]), at[2]) - 1.0F,
                        high = glm::max(glm::max(at[0], at[1]), at[2]) + 1.0F;
        for (int y = std::max(static_cast<int>(low.y), 0); y <= std::min(static_cast<int>(high.y), size - 1);
             ++y) {
            for (int x = std::max(static_cast<int>(low.x), 0);
                 x <= std::min(static_cast<int>(high.x), size - 1); ++x) {
                const glm::vec2 rel = glm::vec2(x, y) - at[0];
                const float b = (rel.x * v.y - rel.y * v.x) / area, c = (u.x * rel.y - u.y * rel.x) / area;
                const bool inside = b >= 0 && c >= 0 && b + c <= 1;
                std::uint8_t& green = image.pixels[3 * static_cast<std::size_t>(y * size + x) + 1];
                if (inside || green == 0) {
                    const glm::vec3 part = glm::clamp(glm::vec3(1 - b - c, b, c), 0.0F, 1.0F);
                    const float mm = glm::dot(value, part) / (part.x + part.y + part.z);
                    green = static_cast<std::uint8_t>(
                        std::clamp(std::lround(mm / most_thickness_mm * 255), 1L, 255L));
                }
            }
        }
    }
    return image;
}

} // namespace stimuli::head
