// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <embree3/rtcore.h>

#include <support/error.h>

namespace renderer::reference {
namespace {

/// Let a ray pass through a triangle that it meets from behind.
void pass_back_faces(const RTCFilterFunctionNArguments* arguments) {
    const unsigned n = arguments->N;
    for (unsigned i = 0; i < n; ++i) {
        const float along = RTCRayN_dir_x(arguments->ray, n, i) * RTCHitN_Ng_x(arguments->hit, n, i) +
                            RTCRayN_dir_y(arguments->ray, n, i) * RTCHitN_Ng_y(arguments->hit, n, i) +
                            RTCRayN_dir_z(arguments->ray, n, i) * RTCHitN_Ng_z(arguments->hit, n, i);
        if (along >= 0) {
            arguments->valid[i] = 0;
        }
    }
}

/// Embree must not see rays with infinite or undefined parts.
bool is_sound(const Ray& ray) {
    const double sum = glm::dot(ray.origin_mm, ray.origin_mm) + glm::dot(ray.direction, ray.direction);
    return sum < 1e36 && ray.nearest_mm >= 0 && ray.farthest_mm > ray.nearest_mm;
}

void set(RTCRay& target, const Ray& ray) {
    target.org_x = static_cast<float>(ray.origin_mm.x);
    target.org_y = static_cast<float>(ray.origin_mm.y);
    target.org_z = static_cast<float>(ray.origin_mm.z);
    target.dir_x = static_cast<float>(ray.direction.x);
    target.dir_y = static_cast<float>(ray.direction.y);
    target.dir_z = static_cast<float>(ray.direction.z);
    target.tnear = static_cast<float>(ray.nearest_mm);
    target.tfar = static_cast<float>(std::min(ray.farthest_mm, 1e30));
    target.time = 0;
    target.mask = std::numeric_limits<unsigned>::max();
    target.id = 0;
    target.flags = 0;
}

} // namespace

glm::dvec3 Corners::normal() const {
    const glm::dvec3 n = cross();
    const double length = glm::length(n);
    return length > 0 ? n / length : glm::dvec3(0, 0, 1);
}

struct Geometry::Embree {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    Embree() = default;
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;
    ~Embree() {
        if (scene != nullptr) {
            rtcReleaseScene(scene);
        }
        if (device != nullptr) {
            rtcReleaseDevice(device);
        }
    }

    void require_success() const {
        const RTCError error = rtcGetDeviceError(device);
        if (error != RTC_ERROR_NONE) {
            throw support::failure("Embree: the model cannot be prepared for rays: error {}",
                                   static_cast<int>(error));
        }
    }

    void attach(const scene::Mesh& mesh, bool double_sided) const {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   mesh.vertices.data(), offsetof(scene::Vertex, position_mm),
                                   sizeof(scene::Vertex), mesh.vertices.size());
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices.data(),
                                   0, 3 * sizeof(std::uint32_t), mesh.indices.size() / 3);
        if (!double_sided) {
            rtcSetGeometryIntersectFilterFunction(geometry, pass_back_faces);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
    }
};

Geometry::Geometry(scene::Model model) : model_(std::move(model)), embree_(std::make_unique<Embree>()) {
    const scene::Bounds world = scene::bounds(model_);
    origin_mm_ = 0.5 * (glm::dvec3(world.low) + glm::dvec3(world.high));
    for (scene::Mesh& mesh : model_.meshes) {
        for (scene::Vertex& vertex : mesh.vertices) {
            vertex.position_mm = glm::vec3(glm::dvec3(vertex.position_mm) - origin_mm_);
        }
        scene::mend_directions(mesh);
    }
    bounds_ = scene::bounds(model_);
    // A few units in the last place of the largest coordinate.
    const glm::vec3 far = glm::max(glm::abs(bounds_.low), glm::abs(bounds_.high));
    epsilon_mm_ = 8.0 * static_cast<double>(std::max({far.x, far.y, far.z})) *
                  static_cast<double>(std::numeric_limits<float>::epsilon());

    embree_->device = rtcNewDevice(nullptr);
    if (embree_->device == nullptr) {
        throw support::failure("Embree: no device: error {}", static_cast<int>(rtcGetDeviceError(nullptr)));
    }
    embree_->scene = rtcNewScene(embree_->device);
    rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_ROBUST);
    for (const scene::Mesh& mesh : model_.meshes) {
        embree_->attach(mesh, model_.materials[mesh.material].double_sided);
    }
    rtcCommitScene(embree_->scene);
    embree_->require_success();
}

Geometry::~Geometry() = default;

std::optional<Place> Geometry::nearest(const Ray& ray) const {
    if (!is_sound(ray)) {
        return std::nullopt;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query;
    set(query.ray, ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embree_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return std::nullopt;
    }
    return Place{{query.hit.geomID, query.hit.primID},
                 {static_cast<double>(query.hit.u), static_cast<double>(query.hit.v)}};
}

bool Geometry::blocked(const Ray& ray) const {
    if (!is_sound(ray)) {
        return false;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay query;
    set(query, ray);
    rtcOccluded1(embree_->scene, &context, &query);
    return query.tfar < 0;
}

Corners Geometry::corners(TriangleId id) const {
    return {vertex(id, 0).position_mm, vertex(id, 1).position_mm, vertex(id, 2).position_mm};
}

} // namespace renderer::reference
