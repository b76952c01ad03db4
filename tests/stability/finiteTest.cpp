// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <support/error.h>

#include "configuration.h"
#include "images.h"
#include "models.h"

namespace stability {
namespace {

using FiniteTest = RenderingTest;

/// Whether texture space may say no: a mesh without texture coordinates, or no triangle that surely covers a
/// texel.
bool may_lack_uvs(const Case& given) {
    const auto size = static_cast<float>(given.methods.ts.map_size);
    glm::vec2 low(0);
    glm::vec2 high(1);
    float greatest_area = 0;
    for (const renderer::scene::Mesh& mesh : given.model.meshes) {
        if (!mesh.has_uv) {
            return true;
        }
        for (const renderer::scene::Vertex& vertex : mesh.vertices) {
            low = glm::min(low, vertex.uv);
            high = glm::max(high, vertex.uv);
        }
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const glm::vec2 corner = mesh.vertices[mesh.indices[i]].uv;
            const glm::vec2 u = mesh.vertices[mesh.indices[i + 1]].uv - corner;
            const glm::vec2 v = mesh.vertices[mesh.indices[i + 2]].uv - corner;
            greatest_area = std::max(greatest_area, std::abs(u.x * v.y - u.y * v.x) / 2);
        }
    }
    return greatest_area * size * size < 16 * (high.x - low.x) * (high.y - low.y);
}

/// A white square, larger than the image, in light that gives it the radiance 1.
Case filled(int width, int height, int samples) {
    Case given;
    given.model = square(1000, 1);
    given.look.profile = renderer::optics::profile("skin_6g_deon2007");
    given.look.specular_intensity = 0;
    given.look.samples = samples;
    given.look.bloom_strength = 0.5f;
    given.methods.ts.map_size = 64;
    given.light.irradiance = glm::vec3(std::numbers::pi_v<float>);
    given.camera.eye_mm.z = 100;
    given.camera.fov_rad = 2 * std::atan(2.0f / static_cast<float>(std::max(1, width / height)));
    given.camera.width = width;
    given.camera.height = height;
    return given;
}

/// Every value is 1, to 1/1024.
testing::AssertionResult is_filled(const Frame& frame) {
    for (std::size_t i = 0; i < frame.linear.size(); ++i) {
        if (!(std::abs(frame.linear[i] - 1) <= 1.0f / 1024)) {
            return testing::AssertionFailure()
                   << "pixel " << i / 4 << " channel " << i % 4 << " is " << frame.linear[i];
        }
    }
    return testing::AssertionSuccess();
}

} // namespace

TEST_F(FiniteTest, everyValueOfAHostileConfigurationIsFiniteAndRepeats) {
    const Indices range = indices(24);
    for (std::uint64_t index = range.first; index < range.last; ++index) {
        const Case given = hostile(index);
        SCOPED_TRACE("SKIN2AFC_STABILITY_ONLY=" + std::to_string(index) + ", " + given.name);
        renderer::passes::Pipeline pipeline(given.model, given.look, given.methods);
        renderer::passes::Pipeline again(given.model, given.look, given.methods);
        for (const Shader shader : all_shaders) {
            SCOPED_TRACE(renderer::passes::shader_name(shader));
            try {
                const Frame frame = pipeline.render(shader, given.camera, given.light, true);
                EXPECT_TRUE(is_sound(frame));
                EXPECT_TRUE(is_same(frame, again.render(shader, given.camera, given.light, true)));
            } catch (const support::InputError& error) {
                EXPECT_TRUE(shader == Shader::ts && may_lack_uvs(given)) << error.what();
            }
        }
    }
}

// A square that fills the image shows its light in every pixel, however few or many they are.
TEST_F(FiniteTest, imagesMayHaveAnySize) {
    for (const auto& [width, height] :
         {std::pair{1, 1}, {1, 37}, {2, 2}, {3, 5}, {8192, 1}, {1, 8192}, {1001, 777}}) {
        SCOPED_TRACE(std::to_string(width) + 'x' + std::to_string(height));
        const Case given = filled(width, height, 4);
        renderer::passes::Pipeline pipeline(given.model, given.look, given.methods);
        for (const Shader shader : all_shaders) {
            const Frame frame = pipeline.render(shader, given.camera, given.light, true);
            EXPECT_TRUE(is_filled(frame)) << renderer::passes::shader_name(shader);
        }
    }
}

// Beyond 2^24 texels floats miss whole numbers, and a filter that steps from texel to texel never ends. A
// white map is white wherever it is read, so that nothing may show.
TEST_F(FiniteTest, mapsMayRepeatMillionsOfTimes) {
    Case given = filled(40, 30, 1);
    given.model.materials[0].base_color = std::make_shared<renderer::scene::Image>(
        renderer::scene::Image{16, 8, 3, std::vector<std::uint8_t>(std::size_t{3} * 16 * 8, 255)});
    for (renderer::scene::Vertex& vertex : given.model.meshes[0].vertices) {
        vertex.uv = vertex.uv * 1e6f + 3e6f;
    }
    // Seen from the side, where maps are filtered anisotropically.
    given.camera.eye_mm.x = -200;
    given.camera.fov_rad = 0.5f;
    for (const Shader shader : {Shader::no_sss, Shader::ss_jittered, Shader::ss_full}) {
        EXPECT_TRUE(is_filled(rendered(given, shader))) << renderer::passes::shader_name(shader);
    }
}

// Up to 12 GiB of textures: for the long sweep alone.
TEST_F(FiniteTest, imagesMayHaveThousandsOfRows) {
    if (indices(0).last < 1000) {
        GTEST_SKIP() << "set SKIN2AFC_STABILITY_COUNT to 1000 or more";
    }
    EXPECT_TRUE(is_filled(rendered(filled(8192, 8192, 1), Shader::no_sss)));
    for (const Shader shader : all_shaders) {
        EXPECT_TRUE(is_filled(rendered(filled(4095, 8192, 1), shader)))
            << renderer::passes::shader_name(shader);
    }
}

} // namespace stability
