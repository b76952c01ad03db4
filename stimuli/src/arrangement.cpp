// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "arrangement.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <renderer/scene/camera.h>
#include <support/error.h>

namespace stimuli {
namespace {

namespace scene = renderer::scene;

void mark_materials(scene::Model& model, const std::vector<std::string>& not_skin) {
    for (const std::string& name : not_skin) {
        bool found = false;
        std::vector<std::string> names;
        for (scene::Material& material : model.materials) {
            names.push_back(support::one_line(material.name));
            if (material.name == name) {
                material.scatters = false;
                found = true;
            }
        }
        if (!found) {
            throw support::input_error("{}: not_skin: expected names of its materials ({}), found \"{}\"",
                                       model.name, fmt::join(names, ", "), support::one_line(name));
        }
    }
}

scene::Mesh placed(scene::Mesh mesh, const study::Placement& placement) {
    const double turn_rad = glm::radians(placement.turn_deg);
    const double c = std::cos(turn_rad);
    const double s = std::sin(turn_rad);
    const auto turn = [&](const glm::vec3& v) {
        const glm::dvec3 d(v);
        return glm::dvec3(c * d.x + s * d.z, d.y, c * d.z - s * d.x);
    };
    const glm::dvec3 place(placement.place_mm[0], placement.place_mm[1], placement.place_mm[2]);
    for (scene::Vertex& vertex : mesh.vertices) {
        vertex.position_mm = glm::vec3(turn(vertex.position_mm) + place);
        vertex.normal = glm::vec3(turn(vertex.normal));
        vertex.tangent = glm::vec4(glm::vec3(turn(glm::vec3(vertex.tangent))), vertex.tangent.w);
    }
    return mesh;
}

void add_screen(scene::Model& model, const study::ScreenSettings& screen, const glm::vec3& centre_mm) {
    scene::Material material;
    material.name = "screen";
    material.base_color_factor = glm::vec3(screen_grey);
    material.double_sided = true;
    material.scatters = false;
    scene::Mesh mesh;
    mesh.material = model.materials.size();
    mesh.has_uv = true;
    mesh.indices = {0, 1, 3, 0, 3, 2};
    for (int corner = 0; corner < 4; ++corner) {
        const glm::vec2 uv(corner & 1, corner >> 1);
        const glm::vec3 place(centre_mm.x + (uv.x - 0.5f) * static_cast<float>(screen.width_mm),
                              centre_mm.y + (uv.y - 0.5f) * static_cast<float>(screen.height_mm),
                              static_cast<float>(screen.z_mm));
        mesh.vertices.push_back({place, {0, 0, 1}, {1, 0, 0, 1}, uv});
    }
    model.materials.push_back(std::move(material));
    model.meshes.push_back(std::move(mesh));
}

} // namespace

scene::Model arranged(scene::Model model, const study::Protocol& protocol) {
    mark_materials(model, protocol.model.not_skin);
    if (!protocol.scene.heads.empty()) {
        scene::Model copies;
        copies.name = model.name;
        copies.digest = model.digest;
        for (const study::Placement& placement : protocol.scene.heads) {
            for (const scene::Mesh& mesh : model.meshes) {
                copies.meshes.push_back(placed(mesh, placement));
                copies.meshes.back().material += copies.materials.size();
            }
            copies.materials.insert(copies.materials.end(), model.materials.begin(), model.materials.end());
        }
        model = std::move(copies);
    }
    if (protocol.scene.screen) {
        const auto height_mm = static_cast<float>(protocol.model.head_height_mm);
        add_screen(model, *protocol.scene.screen, scene::top_of(model, height_mm).centre_mm);
    }
    return model;
}

} // namespace stimuli
