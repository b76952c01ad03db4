// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "plane.h"

#include <cmath>
#include <numbers>

namespace scenes {

namespace passes = renderer::passes;
namespace scene = renderer::scene;

constexpr float pi = std::numbers::pi_v<float>;

scene::Model plane(float side_mm) {
    const float h = side_mm / 2;
    scene::Mesh mesh;
    const glm::vec3 n(0, 0, 1);
    const glm::vec4 t(1, 0, 0, 1);
    mesh.vertices = {{{-h, -h, 0}, n, t, {0, 1}},
                     {{h, -h, 0}, n, t, {1, 1}},
                     {{h, h, 0}, n, t, {1, 0}},
                     {{-h, h, 0}, n, t, {0, 0}}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.has_uv = true;
    scene::Model model;
    model.name = "plane";
    model.materials.emplace_back();
    model.meshes.push_back(mesh);
    return model;
}

scene::Model half_white_plane(float side_mm) {
    scene::Model model = plane(side_mm);
    auto image = std::make_shared<scene::Image>(scene::Image{1024, 1, 3, {}});
    image->pixels.assign(3 * 1024, 0);
    std::fill_n(image->pixels.begin(), 3 * 512, std::uint8_t{255});
    model.materials[0].base_color = image;
    return model;
}

void turn(scene::Model& model, float angle_rad) {
    const float c = std::cos(angle_rad);
    const float s = std::sin(angle_rad);
    const glm::mat3 rotation(c, 0, -s, 0, 1, 0, s, 0, c);
    for (scene::Mesh& mesh : model.meshes) {
        for (scene::Vertex& v : mesh.vertices) {
            v.position_mm = rotation * v.position_mm;
            v.normal = rotation * v.normal;
            v.tangent = glm::vec4(rotation * glm::vec3(v.tangent), v.tangent.w);
        }
    }
}

scene::Model sphere(float radius_mm) {
    constexpr int columns = 256, rows = 128;
    scene::Mesh mesh;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            const float u = static_cast<float>(i) / columns;
            const float v = static_cast<float>(j) / rows;
            const glm::vec3 n(-std::sin(2 * pi * u) * std::sin(pi * v), std::cos(pi * v),
                              -std::cos(2 * pi * u) * std::sin(pi * v)); // the seam is behind
            mesh.vertices.push_back({radius_mm * n, n, {}, {u, v}});
        }
    }
    const auto index = [](int i, int j) { return static_cast<std::uint32_t>(j * (columns + 1) + i); };
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const std::uint32_t a = index(i, j);
            const std::uint32_t b = index(i, j + 1);
            const std::uint32_t c = index(i + 1, j + 1);
            const std::uint32_t d = index(i + 1, j);
            mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
        }
    }
    mesh.has_uv = true;
    scene::compute_tangents(mesh);
    scene::Model model;
    model.name = "sphere";
    model.materials.emplace_back();
    model.meshes.push_back(std::move(mesh));
    return model;
}

passes::Look diffuse_look() {
    passes::Look look;
    look.profile = renderer::optics::profile("skin_6g_deon2007");
    look.texture_mix = 1;
    look.specular_intensity = 0;
    return look;
}

passes::Light frontal_light() {
    passes::Light light;
    light.direction = {0, 0, 1};
    light.irradiance = glm::vec3(pi);
    light.shadow_softness_mm = 0;
    return light;
}

scene::Camera camera(float distance_mm, int width, int height) {
    return {{0, 0, distance_mm}, {0, 0, 0}, 20 * pi / 180, width, height};
}

glm::vec4 value(const passes::Frame& frame, int x, int y) {
    const float* p = &frame.linear[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                                        static_cast<std::size_t>(x))];
    return {p[0], p[1], p[2], p[3]};
}

} // namespace scenes
