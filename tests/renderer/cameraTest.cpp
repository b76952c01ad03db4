// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <cmath>

#include <gtest/gtest.h>

#include <renderer/scene/camera.h>

namespace scene = renderer::scene;

namespace {

constexpr float pi = 3.14159265f;

/// Where a camera puts a place, pixels from the image's lower left corner.
glm::vec2 pixel_of(const scene::Camera& camera, const glm::vec3& place_mm) {
    const scene::Bounds around{place_mm - 1.0f, place_mm + 1.0f};
    const glm::vec4 clip =
        camera.projection(around) * glm::vec4(camera.rotation() * (place_mm - camera.eye_mm), 1);
    const glm::vec2 ndc = glm::vec2(clip) / clip.w;
    return (0.5f * ndc + 0.5f) *
           glm::vec2(static_cast<float>(camera.width), static_cast<float>(camera.height));
}

} // namespace

// In the far view of the paper the head, 27 units tall, is seen from 132 units: 27 / (2 * 132 tan 10 deg) of
// the height.
TEST(CameraTest, showsTheHeadOfThePaperAtItsSize) {
    const scene::HeadFrame head{{5, 300, -7}, 232};
    const scene::Camera camera = scene::facing(head, 132 * 232.0f / 27, 20 * pi / 180, 1650, 988);
    const glm::vec2 vertex = pixel_of(camera, head.centre_mm + glm::vec3(0, 116, 0));
    const glm::vec2 chin = pixel_of(camera, head.centre_mm - glm::vec3(0, 116, 0));
    const double expected = 988 * 27 / (2 * 132 * std::tan(10 * static_cast<double>(pi) / 180));
    EXPECT_NEAR(static_cast<double>(vertex.y - chin.y), expected, 0.1);
    EXPECT_NEAR(vertex.x, 825, 0.01f);
    EXPECT_NEAR(vertex.y + chin.y, 988, 0.02f);
}

TEST(CameraTest, focalLengthIsPixelsPerMillimetreAtUnitDepth) {
    const scene::HeadFrame head{{0, 0, 0}, 232};
    const scene::Camera camera = scene::facing(head, 500, 20 * pi / 180, 1650, 988);
    const glm::vec2 a = pixel_of(camera, {0, 0, 0});
    const glm::vec2 b = pixel_of(camera, {3, 0, 0});
    EXPECT_NEAR(b.x - a.x, 3 * camera.focal_px() / 500, 1e-2f);
}

TEST(CameraTest, lightTurnsFromTheFaceToItsLeft) {
    const glm::vec3 front = scene::light_direction(0, pi / 4);
    EXPECT_NEAR(front.y, std::sqrt(0.5f), 1e-6f);
    EXPECT_NEAR(front.z, std::sqrt(0.5f), 1e-6f);
    const glm::vec3 side = scene::light_direction(pi / 2, 0);
    EXPECT_NEAR(side.x, 1, 1e-6f); // about +Y, from +Z to +X
    EXPECT_NEAR(glm::length(scene::light_direction(2, 0.7f)), 1, 1e-6f);
}

TEST(CameraTest, headIsTheTopOfTheModel) {
    scene::Model model;
    scene::Mesh mesh;
    // Shoulders reach far to the side, below the head.
    for (const glm::vec3 place : {glm::vec3(-10, 400, 0), glm::vec3(30, 300, 80), glm::vec3(0, 200, -20),
                                  glm::vec3(-500, 0, 0), glm::vec3(500, 0, 0), glm::vec3(0, 0, 90)}) {
        mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
        mesh.vertices.push_back({place, {}, {}, {}});
    }
    model.meshes.push_back(mesh);
    const scene::HeadFrame head = scene::top_of(model, 232);
    EXPECT_EQ(head.centre_mm, glm::vec3(10, 400 - 116, 30));
}
