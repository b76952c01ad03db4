// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

// What a frame skips must not show, and must be skipped indeed.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <renderer/gl/context.h>
#include <renderer/passes/pipeline.h>

#include "plane.h"

namespace {

namespace passes = renderer::passes;
namespace scene = renderer::scene;
using passes::Shader;
using passes::Switches;

constexpr Shader all_shaders[] = {Shader::no_sss, Shader::ts, Shader::ss_jittered, Shader::ss_full};

class SkippingTest : public testing::Test {
protected:
    static void SetUpTestSuite() { context.emplace(renderer::gl::Context::headless()); }
    static void TearDownTestSuite() { context.reset(); }

private:
    static std::optional<renderer::gl::Context> context;
};
std::optional<renderer::gl::Context> SkippingTest::context;

/// Add a copy of a model, moved, with a material of its own.
void add(scene::Model& model, const scene::Model& part, const glm::vec3& place_mm) {
    for (scene::Mesh mesh : part.meshes) {
        for (scene::Vertex& vertex : mesh.vertices) {
            vertex.position_mm += place_mm;
        }
        mesh.material += model.materials.size();
        model.meshes.push_back(std::move(mesh));
    }
    model.materials.insert(model.materials.end(), part.materials.begin(), part.materials.end());
}

/// A ball behind another, a third out of view, and a grey square that is not skin before a corner.
scene::Model crowd() {
    scene::Model model;
    const scene::Model ball = scenes::sphere(40);
    add(model, ball, {20, 0, -150});
    add(model, ball, {0, 0, 0});
    add(model, ball, {2000, 0, 0});
    scene::Model square = scenes::plane(40);
    square.materials[0].scatters = false;
    square.materials[0].base_color = nullptr;
    square.materials[0].base_color_factor = glm::vec3(0.2f);
    add(model, square, {-35, 25, 60});
    return model;
}

/// A key light and one from behind.
scene::Light two_lights() {
    scene::Light light = scenes::frontal_light();
    light.direction = glm::normalize(glm::vec3(1, 1, 1));
    light.ambient_irradiance = glm::vec3(0.2f);
    light.shadow_map_size = 256;
    light.further = {{glm::normalize(glm::vec3(-1, 0.5f, -0.2f)), glm::vec3(1, 0.8f, 0.6f)}};
    return light;
}

passes::Look look() {
    passes::Look result;
    result.profile = renderer::optics::profile("skin_6g_deon2007");
    result.bloom_strength = 0.1f;
    result.bloom_sigma_px = 3;
    result.background = {0.1f, 0.2f, 0.3f};
    return result;
}

passes::Methods methods() {
    passes::Methods result;
    result.ts.map_size = 128;
    return result;
}

passes::Frame frame_of(const scene::Model& model, Shader shader, const scene::Camera& camera,
                       const scene::Light& light, const Switches& switches,
                       const passes::Methods& how = methods()) {
    passes::Pipeline pipeline(model, look(), how, switches);
    // An earlier frame of another view must leave nothing behind.
    scene::Camera other = camera;
    other.eye_mm += glm::vec3(60, 30, -20);
    pipeline.draw(shader, other, light, true);
    return pipeline.render(shader, camera, light, true);
}

/// Root mean square of the difference, steps of 255.
double rms(const passes::Frame& a, const passes::Frame& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.srgb.size(); ++i) {
        const double d = int{a.srgb[i]} - int{b.srgb[i]};
        sum += d * d;
    }
    return std::sqrt(sum / static_cast<double>(a.srgb.size()));
}

long long count(const passes::Frame& frame, const char* name) {
    const auto found = frame.counts.find(name);
    return found == frame.counts.end() ? 0 : found->second;
}

bool says(const std::vector<std::string>& lines, std::string_view what) {
    return std::any_of(lines.begin(), lines.end(),
                       [&](const std::string& line) { return line.find(what) != std::string::npos; });
}

/// What a query counts while a frame is drawn a second time.
GLuint64 counted(GLenum query_target, const Switches& switches, const scene::Model& model, Shader shader,
                 const scene::Camera& camera) {
    Switches anew = switches;
    anew.share = false;
    passes::Pipeline pipeline(model, look(), methods(), anew);
    pipeline.draw(shader, camera, two_lights());
    GLuint query = 0;
    glGenQueries(1, &query); // glCreateQueries does not know all targets in Mesa 22
    glBeginQuery(query_target, query);
    pipeline.draw(shader, camera, two_lights());
    glEndQuery(query_target);
    GLuint64 result = 0;
    glGetQueryObjectui64v(query, GL_QUERY_RESULT, &result);
    glDeleteQueries(1, &query);
    return result;
}

} // namespace

TEST_F(SkippingTest, noSwitchShowsBeyondItsBound) {
    const scene::Model model = crowd();
    for (const float distance_mm : {280.0f, 900.0f, 4000.0f}) { // Gaussians seen, seen in part, not seen
        const scene::Camera camera = scenes::camera(distance_mm, 96, 72);
        for (const Shader shader : all_shaders) {
            const passes::Frame with = frame_of(model, shader, camera, two_lights(), {});
            for (const passes::SwitchEntry& entry : passes::switch_list) {
                SCOPED_TRACE(std::string(entry.name) + ' ' + std::string(passes::shader_name(shader)) + ' ' +
                             std::to_string(distance_mm));
                Switches switches;
                switches.*entry.member = false;
                const passes::Frame without = frame_of(model, shader, camera, two_lights(), switches);
                if (entry.bound == 0) {
                    EXPECT_EQ(with.srgb, without.srgb);
                    EXPECT_EQ(0, std::memcmp(with.linear.data(), without.linear.data(),
                                             with.linear.size() * sizeof(float)));
                } else {
                    EXPECT_LE(rms(with, without), entry.bound);
                }
            }
        }
    }
}

// The surface on the screen depends on the camera alone, the narrowest Gaussian on the lit frame alone, and
// ts and ss_full both need it.
TEST_F(SkippingTest, whatShadersHaveInCommonIsMadeOnceAndChangesNoBit) {
    const scene::Model model = crowd();
    const scene::Camera camera = scenes::camera(180, 384, 288); // near enough to see it
    scene::Light other_light = two_lights();
    other_light.direction = glm::normalize(glm::vec3(-1, 1, 1));
    passes::Pipeline shared(model, look(), methods());
    const auto has = [](const std::vector<std::string>& nodes) { return says(nodes, "narrowest Gaussian"); };

    const passes::Frame first = shared.render(Shader::ts, camera, two_lights(), true);
    EXPECT_TRUE(has(first.passes_run));
    EXPECT_EQ(count(first, "surfaces"), 1);
    const passes::Frame jittered = shared.render(Shader::ss_jittered, camera, two_lights(), true);
    EXPECT_EQ(count(jittered, "surfaces"), 0);
    const passes::Frame full = shared.render(Shader::ss_full, camera, two_lights(), true);
    EXPECT_TRUE(has(full.passes_reused));
    EXPECT_FALSE(has(full.passes_run));
    const long long at_half = count(full, "gaussians at half resolution") > 0 ? 1 : 0;
    EXPECT_EQ(count(full, "surfaces"), at_half);
    EXPECT_EQ(count(full, "blur passes"),
              2 * (count(full, "gaussians") + count(full, "gaussians in part") - 1));
    // Another light leaves the surface where it is, another camera does not.
    const passes::Frame relit = shared.render(Shader::ss_full, camera, other_light, true);
    EXPECT_TRUE(has(relit.passes_run));
    EXPECT_EQ(count(relit, "surfaces"), 0);
    const scene::Camera other_camera = scenes::camera(190, 384, 288);
    const passes::Frame moved = shared.render(Shader::ss_full, other_camera, other_light, true);
    EXPECT_EQ(count(moved, "surfaces"), 1 + at_half);

    // Each is the image that a pipeline of its own makes.
    const auto alone = [&](Shader shader, const scene::Camera& from, const scene::Light& light) {
        return passes::Pipeline(model, look(), methods()).render(shader, from, light, true).linear;
    };
    EXPECT_EQ(first.linear, alone(Shader::ts, camera, two_lights()));
    EXPECT_EQ(jittered.linear, alone(Shader::ss_jittered, camera, two_lights()));
    EXPECT_EQ(full.linear, alone(Shader::ss_full, camera, two_lights()));
    EXPECT_EQ(relit.linear, alone(Shader::ss_full, camera, other_light));
    EXPECT_EQ(moved.linear, alone(Shader::ss_full, other_camera, other_light));
}

TEST_F(SkippingTest, bothWaysToSumGaussiansGiveTheSameImage) {
    const scene::Model model = crowd();
    for (const bool half : {false, true}) {
        passes::Methods on_the_fly = methods();
        on_the_fly.full.half_resolution = half;
        passes::Methods kept = on_the_fly;
        kept.full.accumulation = passes::Accumulation::weighted_sum;
        for (const float distance_mm : {280.0f, 900.0f}) {
            const scene::Camera camera = scenes::camera(distance_mm, 96, 72);
            const auto a = frame_of(model, Shader::ss_full, camera, two_lights(), {}, on_the_fly);
            const auto b = frame_of(model, Shader::ss_full, camera, two_lights(), {}, kept);
            EXPECT_LE(rms(a, b), 1) << half << ' ' << distance_mm;
        }
    }
}

TEST_F(SkippingTest, trianglesOutOfViewOrTurnedAwayAreNotDrawn) {
    const scene::Model model = crowd();
    const scene::Camera camera = scenes::camera(300, 96, 72);
    const passes::Frame frame = frame_of(model, Shader::no_sss, camera, two_lights(), {});
    // A third of the balls' triangles are out of view, and some of the rest show their backs.
    const auto all = static_cast<double>(count(frame, "triangles") + count(frame, "triangles culled"));
    EXPECT_GT(static_cast<double>(count(frame, "triangles culled")), 0.35 * all);
    EXPECT_GT(count(frame, "triangles"), 0);
    Switches off;
    off.cull = false;
    EXPECT_EQ(count(frame_of(model, Shader::no_sss, camera, two_lights(), off), "triangles culled"), 0);
}

TEST_F(SkippingTest, anEmptyViewDrawsNothingButTheBackground) {
    scene::Camera camera = scenes::camera(300, 96, 72);
    camera.target_mm = camera.eye_mm + glm::vec3(0, 0, 1); // away from all
    for (const Shader shader : all_shaders) {
        const passes::Frame frame = frame_of(crowd(), shader, camera, two_lights(), {});
        EXPECT_EQ(frame.passes_run, (std::vector<std::string>{"output", "read back"}));
        EXPECT_TRUE(says(frame.passes_skipped, "out of view"));
        Switches off;
        off.rectangle = off.cull = false;
        EXPECT_EQ(frame.srgb, frame_of(crowd(), shader, camera, two_lights(), off).srgb);
    }
}

TEST_F(SkippingTest, pixelsBesideTheModelAreLeftOut) {
    const scene::Camera camera = scenes::camera(3000, 96, 72);
    const passes::Frame frame = frame_of(scenes::sphere(40), Shader::ss_full, camera, two_lights(), {});
    EXPECT_GT(count(frame, "pixels outside"), 96 * 72 * 9 / 10);
    EXPECT_GT(count(frame, "pixels"), 0);
}

TEST_F(SkippingTest, lightsThatLightNothingInViewCastNoShadows) {
    scene::Light light = two_lights();
    light.further[0].direction = {0, 0, -1}; // from behind a square that faces the camera
    const scene::Camera camera = scenes::camera(300, 96, 72);
    const passes::Frame frame = frame_of(scenes::plane(50), Shader::ss_full, camera, light, {});
    EXPECT_TRUE(says(frame.passes_skipped, "1 of 2 lights"));
    const scene::Model square = scenes::plane(50);
    passes::Pipeline pipeline(square, look(), methods());
    EXPECT_EQ(count(pipeline.render(Shader::ss_full, camera, light), "shadow maps"), 1);
    Switches off;
    off.skip_unlit = false;
    passes::Pipeline every(square, look(), methods(), off);
    EXPECT_EQ(count(every.render(Shader::ss_full, camera, light), "shadow maps"), 2);
    // A light that grazes the square does light it.
    light.further[0].direction = glm::normalize(glm::vec3(1, 0, 0.1f));
    const passes::Frame grazed = pipeline.render(Shader::ss_full, camera, light);
    EXPECT_FALSE(says(grazed.passes_skipped, "lights"));
    EXPECT_EQ(grazed.srgb, every.render(Shader::ss_full, camera, light).srgb);
}

TEST_F(SkippingTest, gaussiansThatCannotBeSeenAreLeftOutPixelByPixel) {
    // The crowd's balls stand at different depths, so somewhere a Gaussian is seen on one of them alone.
    const scene::Model model = crowd();
    bool in_part = false;
    long long skipped = -1;
    for (float distance_mm = 250; distance_mm < 20000; distance_mm *= 1.1f) {
        const passes::Frame frame =
            frame_of(model, Shader::ss_full, scenes::camera(distance_mm, 48, 36), two_lights(), {});
        EXPECT_GE(count(frame, "gaussians skipped"), skipped) << distance_mm;
        skipped = count(frame, "gaussians skipped");
        in_part = in_part || count(frame, "gaussians in part") > 0;
    }
    EXPECT_TRUE(in_part);
    EXPECT_GE(skipped, 5);
}

// [JimenezGutierrez2010, section 7.3.3]: of the fit of four, the first is too narrow to be noticed.
TEST_F(SkippingTest, theUnblurredImageMayStandForTheNarrowestGaussian) {
    passes::Look four = look();
    four.profile = renderer::optics::profile("skin_4g_jimenez2010");
    passes::Methods unblurred = methods();
    unblurred.full.unblurred_first = true;
    const scene::Model model = crowd();
    passes::Pipeline with(model, four, methods());
    passes::Pipeline without(model, four, unblurred);
    const scene::Camera camera = scenes::camera(180, 384, 288); // near enough to see it
    const passes::Frame a = with.render(Shader::ss_full, camera, two_lights());
    const passes::Frame b = without.render(Shader::ss_full, camera, two_lights());
    EXPECT_EQ(count(a, "gaussians skipped"), 0);
    EXPECT_EQ(count(b, "gaussians skipped"), 1);
    EXPECT_LE(rms(a, b), 1);
}

TEST_F(SkippingTest, whatMaterialsLackIsNotRead) {
    const scene::Camera camera = scenes::camera(300, 96, 72);
    const auto maps = [&](const scene::Model& model, const passes::Look& with) {
        passes::Pipeline pipeline(model, with, methods());
        return count(pipeline.render(Shader::no_sss, camera, two_lights()), "maps read");
    };
    scene::Model bare = scenes::plane(50);
    bare.materials[0].base_color = nullptr;
    passes::Look dull = look();
    dull.specular_intensity = 0;
    EXPECT_EQ(maps(bare, dull), 0);
    EXPECT_EQ(maps(bare, look()), 1);                         // of the specular albedo
    EXPECT_EQ(maps(scenes::half_white_plane(50), look()), 2); // and of the colour
    dull.bloom_strength = 0;
    passes::Pipeline pipeline(bare, dull, methods());
    EXPECT_TRUE(says(pipeline.render(Shader::no_sss, camera, two_lights()).passes_skipped, "bloom"));
}

TEST_F(SkippingTest, samplesBehindAWallAreNotShaded) {
    scene::Model hidden = crowd();
    scene::Model wall = scenes::plane(400);
    wall.materials[0].scatters = false;
    add(hidden, wall, {0, 0, 100});
    const scene::Camera camera = scenes::camera(400, 192, 144);
    Switches off;
    off.front_to_back = false;
    const GLuint64 with = counted(GL_SAMPLES_PASSED, {}, hidden, Shader::no_sss, camera);
    // The balls cover more than a twentieth of the image, with four samples a pixel.
    EXPECT_LT(with + 4 * 192 * 144 / 20, counted(GL_SAMPLES_PASSED, off, hidden, Shader::no_sss, camera));
}

TEST_F(SkippingTest, fragmentsBesideTheModelAreNotShaded) {
    if (!epoxy_has_gl_extension("GL_ARB_pipeline_statistics_query")) {
        GTEST_SKIP() << "this driver does not count fragments";
    }
    constexpr GLenum invocations = GL_FRAGMENT_SHADER_INVOCATIONS_ARB;
    const scene::Model model = scenes::plane(60); // few triangles: llvmpipe counts whole blocks of pixels
    const scene::Camera camera = scenes::camera(800, 192, 144);
    const GLuint64 with = counted(invocations, {}, model, Shader::ss_full, camera);
    Switches off;
    off.rectangle = false;
    EXPECT_LT(2 * with, counted(invocations, off, model, Shader::ss_full, camera));
    if (!renderer::gl::runs_on_cpu()) { // llvmpipe counts fragments before it tests their depth
        off = {};
        off.early_test = false;
        EXPECT_LT(with, counted(invocations, off, model, Shader::ss_full, camera));
    }
}

// A Gaussian that is switched off as the camera moves away changes the image no more than the motion does.
TEST_F(SkippingTest, gaussiansVanishWithoutAPop) {
    const scene::Model model = scenes::half_white_plane(60);
    passes::Pipeline pipeline(model, look(), methods());
    std::vector<passes::Frame> frames;
    std::vector<long long> run;
    for (float distance_mm = 300; distance_mm < 1500; distance_mm *= 1.01f) {
        frames.push_back(
            pipeline.render(Shader::ss_full, scenes::camera(distance_mm, 160, 120), two_lights()));
        run.push_back(100 * count(frames.back(), "gaussians") +
                      count(frames.back(), "gaussians at half resolution"));
    }
    std::vector<double> change;
    for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
        change.push_back(rms(frames[i], frames[i + 1]));
    }
    int switched = 0;
    for (std::size_t i = 3; i + 3 < change.size(); ++i) {
        if (run[i] == run[i + 1]) {
            continue;
        }
        ++switched;
        // Edges step from pixel to pixel, so single neighbours vary; the median of six does not.
        std::vector<double> around{change[i - 3], change[i - 2], change[i - 1],
                                   change[i + 1], change[i + 2], change[i + 3]};
        std::nth_element(around.begin(), around.begin() + 3, around.end());
        EXPECT_LE(change[i], 2 * around[3]) << i << ' ' << run[i] << ' ' << run[i + 1];
    }
    EXPECT_GE(switched, 3);
}

// Targets hold what earlier frames left, and taps reach beyond the pixels that a frame draws.
TEST_F(SkippingTest, whatAnEarlierFrameShowedLeavesNoTrace) {
    const scene::Model models[] = {crowd(), scenes::plane(40)}; // the square fills its rectangle
    std::vector<passes::Methods> ways(5, methods());
    ways[0].full = passes::published_full();
    ways[1].full.reject_gaps = false;
    ways[2].full.target_bits = 16;
    ways[3].full.target_bits = 8;
    ways[4].full.accumulation = passes::Accumulation::weighted_sum;
    ways[4].full.reject_gaps = false;
    scene::Camera before = scenes::camera(300, 320, 240);
    before.target_mm.x += 10;
    long long at_half = 0;
    for (std::size_t i = 0; i < 2 * ways.size(); ++i) {
        const scene::Model& model = models[i / ways.size()];
        const passes::Methods& way = ways[i % ways.size()];
        for (const Shader shader : {Shader::ts, Shader::ss_full}) {
            passes::Pipeline used(model, look(), way);
            for (const float distance_mm : {450.0f, 700.0f}) { // from 300, smaller and smaller on the screen
                const scene::Camera after = scenes::camera(distance_mm, 320, 240);
                used.draw(shader, before, two_lights());
                const passes::Frame again = used.render(shader, after, two_lights(), true);
                passes::Pipeline fresh(model, look(), way);
                const passes::Frame first = fresh.render(shader, after, two_lights(), true);
                EXPECT_EQ(again.linear, first.linear)
                    << i << ' ' << passes::shader_name(shader) << ' ' << distance_mm;
                at_half += count(first, "gaussians at half resolution");
            }
        }
    }
    EXPECT_GT(at_half, 0);
}

// 8-bit targets store signals, not light, also where a Gaussian is seen on some of the skin alone.
TEST_F(SkippingTest, eightBitsKeepTheLightWhereGaussiansAreSeenInPart) {
    const scene::Model model = crowd();
    passes::Methods fine = methods();
    fine.full.target_bits = 32;
    passes::Methods coarse = methods();
    coarse.full.target_bits = 8;
    int in_part = 0;
    for (float distance_mm = 250; distance_mm < 4000; distance_mm *= 1.2f) {
        const scene::Camera camera = scenes::camera(distance_mm, 96, 72);
        const auto a = frame_of(model, Shader::ss_full, camera, two_lights(), {}, fine);
        const auto b = frame_of(model, Shader::ss_full, camera, two_lights(), {}, coarse);
        in_part += count(b, "gaussians in part") > 0 ? 1 : 0;
        EXPECT_LE(rms(a, b), 1.5) << distance_mm; // one step of 255 a blur
    }
    EXPECT_GT(in_part, 0);
}
