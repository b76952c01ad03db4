// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <renderer/gl/context.h>
#include <renderer/passes/pipeline.h>
#include <support/error.h>

#include "plane.h"

namespace passes = renderer::passes;
namespace scene = renderer::scene;
using passes::Shader;

namespace {

constexpr Shader all_shaders[] = {Shader::no_sss, Shader::ts, Shader::ss_jittered, Shader::ss_full};

class PipelineTest : public testing::Test {
protected:
    static void SetUpTestSuite() { context.emplace(renderer::gl::Context::headless()); }
    static void TearDownTestSuite() { context.reset(); }

    static std::optional<renderer::gl::Context> context;
};
std::optional<renderer::gl::Context> PipelineTest::context;

} // namespace

TEST_F(PipelineTest, aUniformlyLitPlaneKeepsItsLight) {
    const scene::Model model = scenes::plane(40);
    passes::Pipeline pipeline(model, scenes::diffuse_look(), {});
    for (const Shader shader : all_shaders) {
        const passes::Frame frame =
            pipeline.render(shader, scenes::camera(150, 160, 96), scenes::frontal_light(), true);
        int covered = 0;
        for (int y = 0; y < frame.height; ++y) {
            for (int x = 0; x < frame.width; ++x) {
                const glm::vec4 v = scenes::value(frame, x, y);
                if (v.a == 1) {
                    ++covered;
                    // Half floats carry 11 bits; six blurs of two passes round twelve times.
                    EXPECT_NEAR(v.g, 1, 0.004f) << passes::shader_name(shader) << ' ' << x << ' ' << y;
                }
            }
        }
        EXPECT_GT(covered, 1000);
    }
}

// A black surface shows the reflection alone, which a material's factor and map scale, each by itself and
// together.
TEST_F(PipelineTest, aMaterialScalesItsReflection) {
    passes::Look look = scenes::diffuse_look();
    look.specular_intensity = 0.5f;
    const auto middle = [&](float factor, std::optional<std::uint8_t> alpha) {
        scene::Model model = scenes::plane(400);
        model.materials[0].base_color_factor = glm::vec3(0);
        model.materials[0].specular_factor = factor;
        if (alpha) {
            model.materials[0].specular =
                std::make_shared<scene::Image>(scene::Image{1, 1, 4, {255, 255, 255, *alpha}});
        }
        passes::Pipeline pipeline(model, look, {});
        return scenes::value(pipeline.render(passes::Shader::no_sss, scenes::camera(500, 64, 48),
                                             scenes::frontal_light(), true),
                             32, 24)
            .g;
    };
    const float whole = middle(1, std::nullopt);
    ASSERT_GT(whole, 0.01f);
    const float rounding = 0.002f * whole; // of packed samples: halves
    EXPECT_NEAR(middle(0.25f, std::nullopt), 0.25f * whole, rounding);
    EXPECT_NEAR(middle(1, 51), 0.2f * whole, rounding);
    EXPECT_NEAR(middle(0.5f, 51), 0.1f * whole, rounding);
    EXPECT_EQ(middle(1, 0), 0);
}

// What is not reflected enters: a white surface without reflection is as bright as under a look without any.
TEST_F(PipelineTest, aMaterialWithoutReflectionLetsAllLightIn) {
    for (const passes::Shader shader : {passes::Shader::no_sss, passes::Shader::ts}) {
        const auto middle = [&](float intensity, bool none) {
            scene::Model model = scenes::plane(400);
            if (none) {
                model.materials[0].specular =
                    std::make_shared<scene::Image>(scene::Image{1, 1, 4, {255, 255, 255, 0}});
            }
            passes::Look look = scenes::diffuse_look();
            look.specular_intensity = intensity;
            look.exposure = 1;
            passes::Pipeline pipeline(model, look, {});
            scene::Light light = scenes::frontal_light();
            light.direction = glm::normalize(glm::vec3(1, 0, 1)); // no highlight at the middle
            return scenes::value(pipeline.render(shader, scenes::camera(500, 64, 48), light, true), 32, 24).g;
        };
        const float without = middle(0, false);
        EXPECT_NEAR(middle(1, true), without, 0.002f * without);
        EXPECT_LT(middle(1, false), 0.98f * without);
    }
}

// No halo: nothing of the skin beside the silhouette, nothing of the background inside.
TEST_F(PipelineTest, silhouettesMixSkinAndBackgroundByCoverageAlone) {
    const scene::Model model = scenes::plane(40);
    passes::Look look = scenes::diffuse_look();
    look.background = {0.25f, 0.5f, 0.125f};
    passes::Pipeline pipeline(model, look, {});
    scene::Camera camera = scenes::camera(300, 160, 96);
    camera.eye_mm.x = camera.target_mm.x = 0.1f; // the plane's edges between pixels
    for (const Shader shader : all_shaders) {
        const passes::Frame frame = pipeline.render(shader, camera, scenes::frontal_light(), true);
        int partial = 0;
        for (int y = 0; y < frame.height; ++y) {
            for (int x = 0; x < frame.width; ++x) {
                const glm::vec4 v = scenes::value(frame, x, y);
                partial += v.a > 0 && v.a < 1 ? 1 : 0;
                const glm::vec3 expected = glm::mix(look.background, glm::vec3(1), v.a);
                for (int c = 0; c < 3; ++c) {
                    ASSERT_NEAR(v[c], expected[c], 0.004f)
                        << passes::shader_name(shader) << ' ' << x << ' ' << y;
                }
            }
        }
        EXPECT_GT(partial, 20);
    }
}

// Lambert's law on a sphere, under light from the side: no acne where it is lit, no light where it faces
// away.
TEST_F(PipelineTest, aSphereShadowsItselfWithoutAcne) {
    const scene::Model model = scenes::sphere(80);
    passes::Pipeline pipeline(model, scenes::diffuse_look(), {});
    passes::Light light = scenes::frontal_light();
    light.direction = glm::normalize(glm::vec3(1, 0.3f, 0.5f));
    light.shadow_softness_mm = 0.8f;
    const scene::Camera camera = scenes::camera(900, 240, 240);
    const passes::Frame frame = pipeline.render(Shader::no_sss, camera, light, true);
    int lit = 0;
    int dark = 0;
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x) {
            // Meet the sphere with the pixel's ray.
            const glm::vec3 ray = glm::normalize(glm::vec3(
                static_cast<float>(x) + 0.5f - 120, 120 - static_cast<float>(y) - 0.5f, -camera.focal_px()));
            const float b = glm::dot(ray, camera.eye_mm);
            const float root = b * b - (900 * 900 - 80 * 80);
            const glm::vec4 v = scenes::value(frame, x, y);
            if (root < 40 * 40 || v.a < 1) { // beside the limb a pixel covers many normals
                continue;
            }
            const glm::vec3 n = (camera.eye_mm + ray * (-b - std::sqrt(root))) / 80.0f;
            const float NoL = glm::dot(n, light.direction);
            if (NoL > 0.1f) {
                ++lit;
                EXPECT_NEAR(v.g, NoL, 0.02f) << x << ' ' << y; // facets of 2 mm and pixel size
            } else if (NoL < -0.05f) {
                ++dark;
                EXPECT_EQ(v.g, 0) << x << ' ' << y;
            }
        }
    }
    EXPECT_GT(lit, 5000);
    EXPECT_GT(dark, 1000);
}

TEST_F(PipelineTest, aBlockerCastsItsShadowAtTheRightPlace) {
    scene::Model model = scenes::plane(100);
    scene::Model blocker = scenes::plane(20);
    for (scene::Vertex& vertex : blocker.meshes[0].vertices) {
        vertex.position_mm.z = 30;
    }
    model.meshes.push_back(blocker.meshes[0]);
    passes::Pipeline pipeline(model, scenes::diffuse_look(), {});
    passes::Light light = scenes::frontal_light();
    light.direction = glm::normalize(glm::vec3(1, 0, 1)); // the shadow falls 30 mm to -x
    light.irradiance *= std::sqrt(2.0f);
    const scene::Camera camera = scenes::camera(600, 300, 200);
    const passes::Frame frame = pipeline.render(Shader::no_sss, camera, light, true);
    const auto at = [&](float x_mm) {
        const int x = static_cast<int>(std::floor(150 + x_mm / 600 * camera.focal_px()));
        return scenes::value(frame, x, 100).g;
    };
    EXPECT_NEAR(at(-30), 0, 1e-3f);
    EXPECT_NEAR(at(-21.5f), 0, 1e-3f);
    EXPECT_NEAR(at(-18.5f), 1, 1e-2f);
    EXPECT_NEAR(at(-41.5f), 1, 1e-2f);
    EXPECT_NEAR(at(-38.5f), 0, 1e-3f);
}

TEST_F(PipelineTest, sharesWhatLightAndCameraLeaveTheSame) {
    const scene::Model model = scenes::plane(40);
    passes::Pipeline pipeline(model, scenes::diffuse_look(), {});
    for (const float distance_mm : {150.0f, 250.0f}) {
        for (const Shader shader : all_shaders) {
            pipeline.render(shader, scenes::camera(distance_mm, 64, 48), scenes::frontal_light());
        }
    }
    EXPECT_EQ(pipeline.costs().at("shadow map").runs, 1);
    EXPECT_EQ(pipeline.costs().at("ts irradiance and blurs").runs, 1);
    EXPECT_EQ(pipeline.costs().at("lit frame").runs, 2);
    EXPECT_EQ(pipeline.costs().at("ss_full").runs, 2);
}

TEST_F(PipelineTest, rendersTheSameBytesWhateverWasRenderedBefore) {
    const scene::Model model = scenes::sphere(60);
    passes::Look look;
    look.profile = renderer::optics::profile("skin_6g_deon2007");
    passes::Light side = scenes::frontal_light();
    side.direction = {1, 0, 0};
    const scene::Camera camera = scenes::camera(500, 128, 96);
    for (const Shader shader : all_shaders) {
        passes::Pipeline fresh(model, look, {});
        passes::Pipeline used(model, look, {});
        for (const Shader other : all_shaders) {
            used.render(other, scenes::camera(350, 128, 96), side);
            used.render(other, camera, scenes::frontal_light());
        }
        EXPECT_EQ(fresh.render(shader, camera, side).srgb, used.render(shader, camera, side).srgb)
            << passes::shader_name(shader);
    }
}

// [Jimenez2009] states alpha = 11 for its stimuli: 988 lines and 20 degrees, where it is to be the physical
// width.
TEST_F(PipelineTest, publishedAlphaElevenIsThePhysicalWidthAtTheSizeOfThePaper) {
    const scene::Model model = scenes::half_white_plane(60);
    passes::Methods published;
    published.full.stretch.alpha = 11.0f;
    passes::Pipeline physical(model, scenes::diffuse_look(), {});
    passes::Pipeline eleven(model, scenes::diffuse_look(), published);
    const scene::Camera camera = scenes::camera(120, 200, 988);
    const passes::Frame a = physical.render(Shader::ss_full, camera, scenes::frontal_light(), true);
    const passes::Frame b = eleven.render(Shader::ss_full, camera, scenes::frontal_light(), true);
    float worst = 0;
    for (std::size_t i = 0; i < a.linear.size(); ++i) {
        worst = std::max(worst, std::abs(a.linear[i] - b.linear[i]));
    }
    EXPECT_LT(worst, 0.003f); // the stated unit has five digits; half floats 11 bits
    published.full.stretch.alpha = 0.0f;
    passes::Pipeline none(model, scenes::diffuse_look(), published);
    const auto beside_edge = [](const passes::Frame& frame) {
        return scenes::value(frame, 90, 494).r;
    }; // 0.4 mm
    EXPECT_NEAR(beside_edge(none.render(Shader::ss_full, camera, scenes::frontal_light(), true)), 1, 0.01f);
    EXPECT_LT(beside_edge(a), 0.9f);
}

TEST_F(PipelineTest, bloomKeepsTheTotalLight) {
    const scene::Model model = scenes::plane(10);
    passes::Look look = scenes::diffuse_look();
    passes::Pipeline without(model, look, {});
    look.bloom_strength = 0.3f;
    look.bloom_sigma_px = 4;
    passes::Pipeline with(model, look, {});
    const scene::Camera camera = scenes::camera(200, 128, 96);
    double sums[2] = {0, 0};
    passes::Frame frames[2] = {without.render(Shader::no_sss, camera, scenes::frontal_light(), true),
                               with.render(Shader::no_sss, camera, scenes::frontal_light(), true)};
    for (int k = 0; k < 2; ++k) {
        for (std::size_t i = 0; i < frames[k].linear.size(); i += 4) {
            sums[k] += static_cast<double>(frames[k].linear[i]);
        }
    }
    EXPECT_NEAR(sums[1] / sums[0], 1, 0.01); // bilinear enlargement of half floats
    EXPECT_NE(frames[0].srgb, frames[1].srgb);
}

// Light from the camera's own direction: V and L meet, and with rounding their cosine passes 1.
TEST_F(PipelineTest, everyPixelIsFiniteUnderAFrontalLight) {
    const scene::Model model = scenes::sphere(80);
    passes::Look look = scenes::diffuse_look();
    look.specular_intensity = 0.18f;
    passes::Pipeline pipeline(model, look, {});
    const passes::Frame frame =
        pipeline.render(Shader::no_sss, scenes::camera(250, 640, 480), scenes::frontal_light(), true);
    for (const float v : frame.linear) {
        ASSERT_TRUE(std::isfinite(v));
    }
}

TEST_F(PipelineTest, saysWhatAModelLacksForTextureSpace) {
    scene::Model bare = scenes::plane(40);
    bare.meshes[0].has_uv = false;
    passes::Pipeline pipeline(bare, scenes::diffuse_look(), {});
    const scene::Camera camera = scenes::camera(150, 64, 48);
    EXPECT_THROW(pipeline.render(Shader::ts, camera, scenes::frontal_light()), support::InputError);
    EXPECT_NO_THROW(pipeline.render(Shader::ss_full, camera, scenes::frontal_light()));

    scene::Model overlapping = scenes::plane(40);
    overlapping.meshes.push_back(overlapping.meshes[0]);
    passes::Pipeline warned(overlapping, scenes::diffuse_look(), {});
    warned.render(Shader::ts, camera, scenes::frontal_light());
    ASSERT_EQ(warned.warnings().size(), 1u);
    EXPECT_NE(warned.warnings()[0].find("overlap on 100.0 %"), std::string::npos) << warned.warnings()[0];
}

// On a surface that turns away, stripes across the direction in which it does are as wide as ever, though
// mipmaps alone blur them, and stripes along it are finer than pixels.
TEST_F(PipelineTest, texturesOfSurfacesThatTurnAwayAreSharpAndSmooth) {
    if (!epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic") &&
        !epoxy_has_gl_extension("GL_ARB_texture_filter_anisotropic")) {
        GTEST_SKIP() << "this driver has no anisotropic filter";
    }
    const auto contrast = [&](float tilt_deg, bool rows) {
        renderer::scene::Image stripes{128, 128, 3, std::vector<std::uint8_t>(3 * 128 * 128)};
        for (std::size_t i = 0; i < stripes.pixels.size(); ++i) {
            stripes.pixels[i] = (rows ? i / (3 * 128) : i / 3) % 2 == 0 ? 255 : 0; // a texel wide
        }
        renderer::scene::Model model = scenes::plane(100);
        model.materials[0].base_color = std::make_shared<renderer::scene::Image>(stripes);
        scenes::turn(model, glm::radians(tilt_deg));
        passes::Pipeline pipeline(model, scenes::diffuse_look(), {});
        const passes::Frame frame =
            pipeline.render(Shader::no_sss, scenes::camera(300, 256, 256), scenes::frontal_light(), true);
        double least = 1e9;
        double most = 0;
        for (int i = -12; i < 12; ++i) {
            const auto red =
                static_cast<double>(scenes::value(frame, rows ? 128 : 128 + i, rows ? 128 + i : 128).r);
            least = std::min(least, red);
            most = std::max(most, red);
        }
        return (most - least) / (most + least);
    };
    EXPECT_GT(contrast(80, true), 0.6 * contrast(0, true));
    EXPECT_LT(contrast(80, false), 0.2 * contrast(0, false));
}

TEST_F(PipelineTest, refusesMoreThanTheDriverCan) {
    passes::Look look = scenes::diffuse_look();
    look.samples = 64;
    const scene::Model model = scenes::plane(40);
    EXPECT_THROW(passes::Pipeline(model, look, {}), support::InputError);
    passes::Pipeline pipeline(model, scenes::diffuse_look(), {});
    EXPECT_THROW(pipeline.prepare(Shader::no_sss, scenes::camera(100, 1 << 20, 16), scenes::frontal_light()),
                 support::InputError);
}

TEST_F(PipelineTest, survivesACameraInsideTheModel) {
    const scene::Model model = scenes::sphere(60);
    passes::Pipeline pipeline(model, scenes::diffuse_look(), {});
    for (const Shader shader : all_shaders) {
        const passes::Frame frame =
            pipeline.render(shader, scenes::camera(1, 64, 48), scenes::frontal_light(), true);
        for (const float v : frame.linear) {
            ASSERT_TRUE(std::isfinite(v));
        }
    }
}
