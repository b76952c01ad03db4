// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include <renderer/gl/context.h>
#include <renderer/passes/pipeline.h>
#include <renderer/reference/reference.h>
#include <support/error.h>

#include "plane.h"

namespace passes = renderer::passes;
namespace scene = renderer::scene;
using passes::Shader;

namespace {

constexpr int width = 320, height = 240;

class DepthOfFieldTest : public testing::Test {
protected:
    static void SetUpTestSuite() { context.emplace(renderer::gl::Context::headless()); }
    static void TearDownTestSuite() { context.reset(); }

    static passes::Frame render(const scene::Model& model, float aperture_mm, float focus_mm = 0,
                                int samples = 4) {
        passes::Look look = scenes::diffuse_look();
        look.aperture_mm = aperture_mm;
        look.focus_mm = focus_mm;
        look.samples = samples;
        passes::Pipeline pipeline(model, look, {});
        return pipeline.render(Shader::no_sss, scenes::camera(150, width, height), scenes::frontal_light(),
                               true);
    }
    static std::optional<renderer::gl::Context> context;
};
std::optional<renderer::gl::Context> DepthOfFieldTest::context;

bool ran(const passes::Frame& frame) {
    return std::find(frame.passes_run.begin(), frame.passes_run.end(), "depth of field") !=
           frame.passes_run.end();
}

} // namespace

TEST_F(DepthOfFieldTest, aPinholeRunsNoPass) {
    EXPECT_FALSE(ran(render(scenes::plane(40), 0)));
    EXPECT_TRUE(ran(render(scenes::plane(40), 5)));
}

TEST_F(DepthOfFieldTest, whatIsInFocusStaysTheSameToTheBit) {
    const scene::Model model = scenes::half_white_plane(40);
    const passes::Frame frame = render(model, 20);
    EXPECT_TRUE(ran(frame));
    EXPECT_EQ(frame.linear, render(model, 0).linear);
}

// A thin lens of diameter A, sharp at f, spreads a point at d over a disk that, in the picture, has the
// radius A / 2 |d - f| / d focal_px / f: here 4 / 2 |150 - 300| / 150 680.6 / 300 = 4.54 pixels. Of such a
// disk, centred half of its radius from a straight edge, 1/2 + (asin(1/2) + sqrt(3)/4) / pi = 0.804 lies on
// the centre's side.
TEST_F(DepthOfFieldTest, anUnsharpEdgeSpreadsOverTheLensesDisk) {
    const passes::Frame frame = render(scenes::half_white_plane(100), 4, 300); // fills the picture
    const auto at = [&](float x) {                                             // between pixels' middles
        const int left = static_cast<int>(std::floor(x - 0.5f));
        const float share = x - 0.5f - static_cast<float>(left);
        return (1 - share) * scenes::value(frame, left, height / 2).g +
               share * scenes::value(frame, left + 1, height / 2).g;
    };
    // 24 taps on whole pixels stand for the disk: a tap too many on one side is 0.04.
    EXPECT_NEAR(at(0.5f * width - 2.27f), 0.804f, 0.08f);
    EXPECT_NEAR(at(0.5f * width + 2.27f), 0.196f, 0.08f);
    EXPECT_NEAR(at(0.5f * width - 7), 1, 0.01f);
    EXPECT_NEAR(at(0.5f * width + 7), 0, 0.01f);
}

// In front: white and sharp. Behind: black and unsharp. One sample a pixel, so that none has both depths.
TEST_F(DepthOfFieldTest, sharpForegroundDoesNotBleed) {
    scene::Model model = scenes::plane(20);
    scene::Model behind = scenes::plane(400);
    behind.materials[0].base_color_factor = glm::vec3(1e-3f);
    for (scene::Vertex& vertex : behind.meshes[0].vertices) {
        vertex.position_mm.z -= 60;
    }
    behind.meshes[0].material = model.materials.size();
    model.materials.push_back(behind.materials[0]);
    model.meshes.push_back(behind.meshes[0]);
    const passes::Frame sharp = render(model, 0, 0, 1);
    const passes::Frame unsharp = render(model, 20, 0, 1);
    EXPECT_TRUE(ran(unsharp));
    for (int x = 0; x < width; ++x) {
        EXPECT_NEAR(scenes::value(unsharp, x, height / 2).g, scenes::value(sharp, x, height / 2).g, 1e-4f)
            << x;
    }
}

TEST_F(DepthOfFieldTest, theReferenceRefusesALens) {
    passes::Look look = scenes::diffuse_look();
    look.aperture_mm = 5;
    EXPECT_THROW(renderer::reference::Reference(scenes::plane(40), look), support::InputError);
}
