// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "frames.h"

#include <algorithm>
#include <memory>

#include <epoxy/gl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <renderer/gl/context.h>
#include <renderer/gl/objects.h>
#include <stimuli/setup.h>
#include <support/error.h>
#include <support/progress.h>
#include <support/random.h>

#include "../accuracy/sweep.h"
#include "../processor.h"
#include "bandwidth.h"
#include "scenes.h"
#include "soundness.h"
#include "stopwatch.h"

namespace measure {
namespace {

namespace gl = renderer::gl;
namespace passes = renderer::passes;
namespace scene = renderer::scene;

// Each frame has a light and a camera that none before it had.
constexpr double turn_deg = 0.0005;
constexpr float step_back = 1e-6f; // share of the distance
constexpr int azimuth_deg = 60;
constexpr int most_samples = 8;
// Frames of nothing are short, and a machine that does other work hurts them most: so many a round.
constexpr int empty_frames = 16;

/// One scene, its camera, and what its settings took.
struct Timed {
    FrameScene scene;
    study::Protocol protocol;
    std::vector<FrameSetting> settings;
    scene::Camera camera;
    std::vector<std::vector<double>> frame_ms;                       // by setting and round
    std::vector<std::map<std::string, std::vector<double>>> node_ms; // by setting, node and round
    std::map<std::string, long long> counts;
    long long skin_pixels = 0;
};

int driver_samples() {
    GLint color = 1, depth = 1, integer = 1;
    glGetIntegerv(GL_MAX_COLOR_TEXTURE_SAMPLES, &color);
    glGetIntegerv(GL_MAX_DEPTH_TEXTURE_SAMPLES, &depth);
    glGetIntegerv(GL_MAX_INTEGER_SAMPLES, &integer);
    int samples = 1;
    while (2 * samples <= std::min({color, depth, integer, most_samples})) {
        samples *= 2;
    }
    return samples;
}

/// One run of the benchmark.
class FramesBenchmark {
public:
    explicit FramesBenchmark(const FramesRequest& request) : request_(request), base_(study_of_2009()) {
        base_.ts.map_size = request.map_size;
        base_.image.width = request.quick ? request.width / 2 : request.width;
        base_.image.height = request.quick ? request.height / 2 : request.height;
        result_.width = base_.image.width;
        result_.height = base_.image.height;
        result_.quick = request.quick;
        result_.rounds = request.rounds > 0 ? request.rounds : request.quick ? 3 : 7;
        result_.processor = processor_name();
        result_.date = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
    }

    FramesResult run() {
        const scene::Model head = stimuli::load_model(base_, request_.model_file);
        head_ = facts(head);
        result_.model = head.name;
        context_.emplace(gl::Context::headless());
        result_.driver = gl::driver_info().renderer;
        result_.on_cpu = gl::runs_on_cpu();
        result_.highest_samples = driver_samples();
        result_.texel_bytes = blur_texel_bytes(passes::FullMethod{}.target_bits, result_.on_cpu);
        std::vector<FrameScene> scenes =
            frame_scenes(result_.highest_samples, request_.quick, !request_.model_file);
        std::erase_if(scenes, [&](const FrameScene& s) { return !wanted(s.places.front().table); });
        if (scenes.empty()) {
            throw support::input_error(
                "--only: expected tables with scenes among them, found {}",
                support::one_line(fmt::format("{}", fmt::join(request_.tables, ", "))));
        }
        if (std::any_of(scenes.begin(), scenes.end(), [](const FrameScene& s) { return s.busts; })) {
            const scene::Model bust = stimuli::load_model(base_, bust_file());
            bust_ = facts(bust);
            result_.bust = bust.name;
        }
        const int blocks = scenes.back().block + 1;
        for (int block = 0; block < blocks; ++block) {
            run_block(scenes, block);
        }
        return std::move(result_);
    }

private:
    const std::optional<std::filesystem::path>& bust_file() const {
        return request_.bust_file ? request_.bust_file : request_.model_file;
    }
    ModelFacts facts(const scene::Model& model) const {
        const scene::HeadFrame head = stimuli::head_frame(base_, model);
        return {scene::bounds(model), {head.centre_mm.x, head.centre_mm.y, head.centre_mm.z}};
    }

    bool wanted(std::string_view table) const {
        return request_.tables.empty() ||
               std::find(request_.tables.begin(), request_.tables.end(), table) != request_.tables.end();
    }

    void run_block(const std::vector<FrameScene>& scenes, int block) {
        std::vector<Timed> all;
        for (const FrameScene& one : scenes) {
            if (one.block == block) {
                all.push_back(prepared(one));
            }
        }
        if (all.empty()) {
            return;
        }
        support::Progress checking(fmt::format("block {}: checking", block + 1), all.size());
        for (Timed& timed : all) {
            check_scene(timed);
            checking.step(timed.scene.name());
        }
        support::Progress timing(fmt::format("block {}: timing", block + 1),
                                 static_cast<std::size_t>(result_.rounds));
        support::Generator generator(fmt::format("bench frames order {}", block), 1);
        for (int round = 1; round <= result_.rounds; ++round) {
            time_round(all, generator);
            timing.step(fmt::format("round {}", round));
        }
        for (const Timed& timed : all) {
            report(timed);
        }
        if (!copy_bytes_per_ms_.empty()) {
            report_copy();
        }
        if (!empty_ms_.empty()) {
            report_empty();
        }
        pipelines_.clear();
        models_.clear();
    }

    scene::Model loaded(const FrameScene& one, const study::Protocol& protocol) const {
        return one.level ? stimuli::load_head(protocol, *one.level)
                         : stimuli::load_model(protocol, one.busts ? bust_file() : request_.model_file);
    }

    Timed prepared(const FrameScene& one) {
        Timed timed;
        timed.scene = one;
        timed.protocol = protocol_of(one, base_, one.busts ? bust_ : head_);
        timed.settings = frame_settings(one, timed.protocol);
        timed.frame_ms.resize(timed.settings.size());
        timed.node_ms.resize(timed.settings.size());
        const auto model = models_.find(one.model_key());
        if (model == models_.end()) {
            models_.emplace(one.model_key(), std::make_unique<scene::Model>(loaded(one, timed.protocol)));
        }
        timed.camera = stimuli::camera(timed.protocol, timed.protocol.camera.distances.front(),
                                       stimuli::head_frame(timed.protocol, *models_.at(one.model_key())));
        return timed;
    }

    /// Settings that differ in the shader alone share a pipeline, and with it the model's maps.
    passes::Pipeline& pipeline(const Timed& timed, std::size_t setting) {
        const FrameSetting& wanted = timed.settings[setting];
        const std::string key =
            fmt::format("{}, {}{}", timed.scene.rig_key(), wanted.switches.cull ? "culling" : "not culling",
                        wanted.methods.ts.culled ? ", culled maps" : "");
        std::unique_ptr<passes::Pipeline>& found = pipelines_[key];
        if (!found) {
            found = std::make_unique<passes::Pipeline>(*models_.at(timed.scene.model_key()),
                                                       stimuli::look(timed.protocol), wanted.methods,
                                                       wanted.switches);
            found->time_nodes(wanted.time_nodes);
        }
        return *found;
    }

    static std::string name_of(const Timed& timed, const FrameSetting& setting) {
        return fmt::format("{} ({}), {}", passes::shader_name(setting.shader), setting.name,
                           timed.scene.name());
    }

    scene::Light next_light(const Timed& timed) {
        return stimuli::light(timed.protocol, azimuth_deg + turn_deg * ++frames_);
    }
    scene::Camera next_camera(const Timed& timed) const {
        scene::Camera camera = timed.camera;
        camera.eye_mm += (camera.eye_mm - camera.target_mm) * (step_back * static_cast<float>(frames_ % 100));
        return camera;
    }

    /// Each setting's frame is sound, and the same twice; this meets all set-up and compilation, too.
    void check_scene(Timed& timed) {
        const scene::Light light = stimuli::light(timed.protocol, azimuth_deg);
        std::optional<scene::Frame> without; // scattering
        for (std::size_t i = 0; i < timed.settings.size(); ++i) {
            const FrameSetting& setting = timed.settings[i];
            passes::Pipeline& used = pipeline(timed, i);
            const scene::Frame first = used.render(setting.shader, timed.camera, light, true);
            const scene::Frame second = used.render(setting.shader, timed.camera, light, true);
            check_same(first, second, timed.scene.outside, name_of(timed, setting));
            if (timed.scene.hidden) {
                without = without ? without : first;
                check_hidden(*without, first, name_of(timed, setting));
            }
            timed.skin_pixels = timed.scene.hidden ? 0 : covered_without_lens(timed, setting);
            timed.counts = first.counts;
        }
    }

    /// The pixels that show skin: without the lens, which spreads them.
    long long covered_without_lens(const Timed& timed, const FrameSetting& setting) {
        scene::Look look = stimuli::look(timed.protocol);
        look.aperture_mm = 0;
        passes::Pipeline pinhole(*models_.at(timed.scene.model_key()), look, setting.methods);
        const scene::Light light = stimuli::light(timed.protocol, azimuth_deg);
        return covered_pixels(pinhole.render(passes::Shader::no_sss, timed.camera, light, true));
    }

    void time_round(std::vector<Timed>& all, support::Generator& generator) {
        std::vector<Timed*> scenes;
        for (Timed& timed : all) {
            scenes.push_back(&timed);
        }
        generator.shuffle(scenes);
        for (Timed* timed : scenes) {
            // A scene's settings stand side by side, so that their ratios suffer least from a machine that
            // drifts.
            std::vector<std::size_t> settings(timed->settings.size());
            for (std::size_t i = 0; i < settings.size(); ++i) {
                settings[i] = i;
            }
            generator.shuffle(settings);
            for (const std::size_t setting : settings) {
                time_frame(*timed, setting);
            }
            if (timed->scene.outside) {
                time_empty(*timed);
            }
            if (timed->scene.effects) {
                copy_bytes_per_ms_.push_back(
                    copy_bytes_per_ms(result_.texel_bytes, result_.width, result_.height));
            }
        }
    }

    void time_frame(Timed& timed, std::size_t at) {
        const FrameSetting& setting = timed.settings[at];
        passes::Pipeline& used = pipeline(timed, at);
        const scene::Light light = next_light(timed);
        const scene::Camera camera = next_camera(timed);
        const passes::Costs before = used.costs();
        timed.frame_ms[at].push_back(gl_time_ms([&] { used.draw(setting.shader, camera, light); }));
        if (setting.time_nodes) {
            std::map<std::string, double> node_ms;
            for (const auto& [node, cost] : used.costs()) {
                const auto earlier = before.find(node);
                const double seconds = cost.seconds - (earlier == before.end() ? 0 : earlier->second.seconds);
                // All of the scattering goes by the shader's name.
                node_ms[node == "narrowest Gaussian" ? "ss_full" : node] += 1000 * seconds;
            }
            for (const auto& [node, ms] : node_ms) {
                timed.node_ms[at][node].push_back(ms);
            }
        }
    }

    /// A frame of nothing beside clearing its target.
    void time_empty(const Timed& timed) {
        passes::Pipeline& used = pipeline(timed, 1);
        const gl::Texture target(GL_RGBA8, result_.width, result_.height);
        const gl::Framebuffer framebuffer({&target});
        const glm::vec4 black(0, 0, 0, 1);
        framebuffer.clear_color(0, black);
        for (int i = 0; i < empty_frames; ++i) {
            const scene::Light light = next_light(timed);
            const scene::Camera camera = next_camera(timed);
            empty_ms_.push_back(gl_time_ms([&] { used.draw(timed.settings[1].shader, camera, light); }));
            clear_ms_.push_back(gl_time_ms([&] { framebuffer.clear_color(0, black); }));
        }
    }

    static double scattering_share(const Timed& timed) {
        const auto& nodes = timed.node_ms.front();
        const auto scattering = nodes.find("ss_full"), lens = nodes.find("depth of field");
        std::vector<double> shares;
        for (std::size_t round = 0; scattering != nodes.end() && round < scattering->second.size(); ++round) {
            const double lens_ms = lens == nodes.end() ? 0 : lens->second[round];
            const double rest_ms = timed.frame_ms.front()[round] - scattering->second[round] - lens_ms;
            shares.push_back(scattering->second[round] / rest_ms);
        }
        return shares.empty() ? 0 : median(shares);
    }

    void report(const Timed& timed) {
        if (timed.scene.effects) {
            EffectRow row;
            row.place = timed.scene.places.front();
            row.skin_pixels = timed.skin_pixels;
            row.counts = timed.counts;
            for (const auto& [node, ms] : timed.node_ms.front()) {
                row.node_ms[node] = median(ms);
                row.node_spread_ms[node] = median_deviation(ms);
            }
            row.scattering_share = scattering_share(timed);
            row.blur_bytes = blur_bytes(timed.counts, timed.skin_pixels, result_.texel_bytes);
            result_.effects.push_back(row);
            return;
        }
        const auto ts = std::find_if(timed.settings.begin(), timed.settings.end(),
                                     [](const FrameSetting& s) { return s.name == faithful; });
        const auto& ts_ms = timed.frame_ms[static_cast<std::size_t>(ts - timed.settings.begin())];
        for (const FramePlace& place : timed.scene.places) {
            for (std::size_t i = 0; i < timed.settings.size(); ++i) {
                FrameRow row;
                row.place = place;
                row.shader = passes::shader_name(timed.settings[i].shader);
                row.setting = timed.settings[i].name;
                row.msaa = timed.scene.samples;
                row.time_ms = median(timed.frame_ms[i]);
                row.time_spread_ms = median_deviation(timed.frame_ms[i]);
                std::vector<double> ratios;
                for (std::size_t round = 0; round < ts_ms.size(); ++round) {
                    ratios.push_back(ts_ms[round] / timed.frame_ms[i][round]);
                }
                row.fps_over_ts = median(ratios);
                const bool multisampled = timed.scene.samples > 1;
                if (row.setting != culled) { // which the papers do not time
                    row.published_fps = published_fps(place, row.shader, multisampled);
                    row.published_fps_over_ts = published_fps_over_ts(place, row.shader, multisampled);
                }
                row.skin_pixels = timed.skin_pixels;
                result_.rows.push_back(row);
            }
        }
    }

    void report_copy() {
        const double copy = median(copy_bytes_per_ms_);
        result_.copy_gb_per_s = 1e-6 * copy;
        for (EffectRow& row : result_.effects) {
            const auto node = row.node_ms.find("ss_full");
            row.blur_share_of_copy = node == row.node_ms.end() ? 0 : row.blur_bytes / node->second / copy;
        }
    }
    void report_empty() {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < empty_ms_.size(); ++i) {
            ratios.push_back(empty_ms_[i] / clear_ms_[i]);
        }
        result_.empty_over_clear = median(ratios);
        result_.empty_ms = median(empty_ms_);
        result_.clear_ms = median(clear_ms_);
    }

    FramesRequest request_;
    study::Protocol base_;
    ModelFacts head_, bust_;
    std::optional<gl::Context> context_;                          // outlives the pipelines
    std::map<std::string, std::unique_ptr<scene::Model>> models_; // outlive the pipelines, of one block
    std::map<std::string, std::unique_ptr<passes::Pipeline>> pipelines_;
    int frames_ = 0;                                              // so far
    std::vector<double> empty_ms_, clear_ms_, copy_bytes_per_ms_; // in the order measured
    FramesResult result_;
};

} // namespace

FramesResult run_frames(const FramesRequest& request) { return FramesBenchmark(request).run(); }

} // namespace measure
