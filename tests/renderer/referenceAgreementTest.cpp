// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include <renderer/gl/context.h>
#include <renderer/passes/pipeline.h>
#include <renderer/reference/reference.h>

#include "plane.h"

namespace passes = renderer::passes;
namespace scene = renderer::scene;

namespace {

/// A smooth pattern that repeats over the image, each channel with a phase of its own.
scene::ImagePtr waves(float middle, float amplitude) {
    constexpr int size = 64;
    auto image = std::make_shared<scene::Image>(scene::Image{size, size, 3, {}});
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            for (int c = 0; c < 3; ++c) {
                const float phase =
                    6.2831853f * (static_cast<float>(x + 2 * y) / size) + static_cast<float>(c);
                image->pixels.push_back(
                    static_cast<std::uint8_t>(std::lround(255 * (middle + amplitude * std::sin(phase)))));
            }
        }
    }
    return image;
}

/// A normal map that tilts to both sides.
scene::ImagePtr tilts() {
    const scene::ImagePtr pattern = waves(0.5f, 0.1f);
    auto image = std::make_shared<scene::Image>(*pattern);
    for (std::size_t i = 2; i < image->pixels.size(); i += 3) {
        image->pixels[i] = 250;
    }
    return image;
}

/// A strength of the reflection that varies over the image.
scene::ImagePtr strengths() {
    const scene::ImagePtr pattern = waves(0.6f, 0.4f);
    auto image = std::make_shared<scene::Image>(scene::Image{pattern->width, pattern->height, 4, {}});
    for (std::size_t i = 0; i < pattern->pixels.size(); i += 3) {
        image->pixels.insert(image->pixels.end(), {0, 0, 0, pattern->pixels[i]});
    }
    return image;
}

} // namespace

// Two renderers that share no code but the tables of specular albedo: without scattering they agree on
// textures, normals, the light's and the eye's side of the material, ambient light, bloom and encoding.
TEST(ReferenceAgreementTest, agreesWithTheUnscatteredPassesOnAllButShadows) {
    const renderer::gl::Context context = renderer::gl::Context::headless();
    scene::Model model = scenes::sphere(60);
    model.materials[0].base_color = waves(0.6f, 0.3f);
    model.materials[0].normal = tilts();
    model.materials[0].roughness = waves(0.7f, 0.2f);
    model.materials[0].roughness_factor = 0.8f;
    model.materials[0].specular = strengths();
    model.materials[0].specular_factor = 0.7f;
    model.materials[0].base_color_factor = {0.9f, 0.7f, 0.5f};
    scene::Look look;
    look.profile.gaussians = {{0, glm::dvec3(1)}};
    look.specular_intensity = 1; // so that an error in the reflection's strength shows
    look.bloom_strength = 0.4f;
    look.bloom_sigma_px = 20;
    look.exposure = 1.3f;
    look.background = {0.1f, 0.2f, 0.3f};
    scene::Light light = scenes::frontal_light();
    light.direction = glm::normalize(glm::vec3(0.4f, 0.3f, 1));
    light.ambient_irradiance = glm::vec3(0.5f);
    light.shadow_map_size = 2048;
    const scene::Camera camera = scenes::camera(500, 301, 201);

    const scene::Frame expected = renderer::reference::Reference(model, look).render(camera, light, true);
    scene::Look with_profile = look;
    with_profile.profile = scenes::diffuse_look().profile; // no_sss reads none, but the pipeline wants one
    passes::Pipeline pipeline(model, with_profile, {});
    const scene::Frame found = pipeline.render(passes::Shader::no_sss, camera, light, true);

    double squares = 0;
    int count = 0;
    for (int y = 0; y < 201; ++y) {
        for (int x = 0; x < 301; ++x) {
            // Leave out the limb and what lies in or near the shadow.
            const glm::vec3 n((static_cast<float>(x) - 150) / 68, (100 - static_cast<float>(y)) / 68, 0);
            const float z2 = 1 - glm::dot(n, n);
            const bool inside = z2 > 0.2f;
            if (inside && glm::dot(glm::vec3(n.x, n.y, std::sqrt(z2)), light.direction) < 0.3f) {
                continue;
            }
            if (!inside && z2 > -0.2f) {
                continue;
            }
            const glm::vec3 d(scenes::value(found, x, y) - scenes::value(expected, x, y));
            squares += static_cast<double>(glm::dot(d, d)) / 3;
            ++count;
        }
    }
    EXPECT_GT(count, 30000);
    EXPECT_LT(std::sqrt(squares / count),
              0.004); // 4 samples, mip levels and half floats against 16 and floats
}
