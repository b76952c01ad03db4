// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "configuration.h"
#include "images.h"
#include "models.h"

namespace stability {
namespace {

using InvarianceTest = RenderingTest;

/// Render two cases with some shaders and compare.
template <typename Compare>
void compare(const Case& a, const Case& b, std::initializer_list<Shader> shaders,
             const Compare& compare_frames) {
    renderer::passes::Pipeline first(a.model, a.look, a.methods);
    renderer::passes::Pipeline second(b.model, b.look, b.methods);
    for (const Shader shader : shaders) {
        SCOPED_TRACE(renderer::passes::shader_name(shader));
        compare_frames(first.render(shader, a.camera, a.light, true),
                       second.render(shader, b.camera, b.light, true));
    }
}

constexpr std::initializer_list<Shader> all = {Shader::no_sss, Shader::ts, Shader::ss_jittered,
                                               Shader::ss_full};

/// A rasteriser rounds corners to 1/256 of a texel, so the last bit of a place decides which texels of the
/// shadow map an edge covers, and which of them lie before a point. A filter over many fine texels keeps most
/// of that below a step of 1/255; few pixels see the rest.
void refine_shadow(Case& given) {
    given.light.shadow_map_size = 512;
    given.light.shadow_softness_mm = std::max(given.light.shadow_softness_mm, 1.0f);
}
constexpr double few_texels = 0.002;

void expect_alike(const Frame& a, const Frame& b) { EXPECT_TRUE(is_alike(a, b, few_texels)); }

/// Visit ordinary cases, each with random numbers of its own.
template <typename Visit>
void each_ordinary(std::uint64_t everyday_count, const Visit& visit) {
    const Indices range = indices(everyday_count);
    for (std::uint64_t index = range.first; index < range.last; ++index) {
        const Case given = ordinary(index);
        SCOPED_TRACE("SKIN2AFC_STABILITY_ONLY=" + std::to_string(index) + ", " + given.name);
        support::Generator random("stability, change", index);
        visit(given, random);
    }
}

} // namespace

TEST_F(InvarianceTest, scaleDoesNotShow) {
    each_ordinary(8, [](Case given, support::Generator& random) {
        const double factor = log_uniform(random, 1e-3, 1e3);
        SCOPED_TRACE("scale " + std::to_string(factor));
        refine_shadow(given);
        compare(given, scaled(given, factor), all, expect_alike);
    });
}

TEST_F(InvarianceTest, turningEverythingDoesNotShow) {
    each_ordinary(8, [](Case given, support::Generator& random) {
        const double angle_rad = 2 * std::numbers::pi * random.uniform();
        SCOPED_TRACE("angle " + std::to_string(angle_rad));
        refine_shadow(given);
        compare(given, turned(given, angle_rad), all, expect_alike);
    });
}

TEST_F(InvarianceTest, theMirrorImageIsTheImageOfTheMirroredScene) {
    each_ordinary(8, [](Case given, support::Generator&) {
        const auto expect_mirrored = [](const Frame& a, const Frame& b) {
            EXPECT_TRUE(is_alike(a, flipped(b), few_texels));
        };
        // The places of several samples have no symmetry.
        given.look.samples = 1;
        // Nor have groups of 2x2 pixels where the number of pixels is odd, by which mipmaps are chosen and
        // halves of the resolution made.
        given.camera.width += given.camera.width % 2;
        refine_shadow(given);
        // Where a surface turns away, mipmaps differ within a group, too. And ss_jittered turns its kernel at
        // random.
        given.model.materials[0].base_color = nullptr;
        compare(given, mirrored(given), {Shader::no_sss, Shader::ss_full}, expect_mirrored);
        given.model = step(70, 20);
        // Texels wider than any pixel, also where the step is seen from the side: so no mipmap is read.
        given.methods.ts.map_size = 16;
        given.camera.width = std::max(given.camera.width, 96);
        given.camera.height = std::max(given.camera.height, 96);
        compare(given, mirrored(given), {Shader::ts}, expect_mirrored);
    });
}

// A place 10 km away is stored to a whole millimetre, so the model's are whole millimetres: then both models
// are the same, and what is left of the details shows as well there as here.
TEST_F(InvarianceTest, tenKilometresFromTheOriginDoNotShow) {
    each_ordinary(8, [](Case given, support::Generator& random) {
        for (renderer::scene::Mesh& mesh : given.model.meshes) {
            for (renderer::scene::Vertex& vertex : mesh.vertices) {
                vertex.position_mm = glm::round(vertex.position_mm);
            }
        }
        given.camera.eye_mm = glm::round(given.camera.eye_mm);
        given.camera.target_mm = glm::round(given.camera.target_mm);
        const double away_mm = 1e7;
        const glm::dvec3 by_mm = away_mm * glm::dvec3(random.below(2) == 0 ? -1 : 1, random.below(2), 1);
        compare(given, moved(given, by_mm), all, expect_alike);
    });
}

TEST_F(InvarianceTest, brighterLightAndShorterExposureDoNotShow) {
    each_ordinary(8, [](const Case& given, support::Generator& random) {
        const double factor = log_uniform(random, 1e-6, 1e6);
        SCOPED_TRACE("light " + std::to_string(factor));
        compare(given, brightened(given, factor), all, expect_alike);
    });
}

} // namespace stability
