// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "sweep.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <measure/picture.h>
#include <measure/scenes.h>
#include <renderer/gl/context.h>
#include <renderer/reference/reference.h>
#include <stimuli/setup.h>
#include <support/error.h>
#include <support/progress.h>
#include <support/random.h>

#include "../processor.h"
#include "frame_check.h"

namespace measure {
namespace {

namespace passes = renderer::passes;
namespace scene = renderer::scene;
using Clock = std::chrono::steady_clock;

// Each timed frame's light is turned by so much more, so that nothing of the frame before can be used again.
constexpr double turn_deg = 0.0005;
// Nodes that every shader runs; the others are its scattering.
constexpr std::array<std::string_view, 6> shared_nodes{"set-up",    "shadow map", "lit frame",
                                                       "composite", "bloom",      "output and read back"};

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

struct View {
    study::Distance distance;
    int azimuth_deg = 0;
    scene::Camera camera;
    Picture truth;
};

/// One run of the benchmark.
class Benchmark {
public:
    explicit Benchmark(const AccuracyRequest& request)
        : protocol_(request.protocol_file ? study::read_protocol(*request.protocol_file) : study_of_2009()),
          model_(load(request, protocol_)) {
        if (request.quick) {
            protocol_.image.width = std::max(16, protocol_.image.width / 4);
            protocol_.image.height = std::max(16, protocol_.image.height / 4);
            protocol_.light.shadow_map_size = std::max(16, protocol_.light.shadow_map_size / 4);
        }
        settings_ = settings(protocol_, request.quick);
        pipelines_.resize(settings_.size());
        result_.quick = request.quick;
        result_.rounds = request.rounds > 0 ? request.rounds : request.quick ? 3 : 9;
        result_.model = model_.name;
        result_.protocol = protocol_.name;
        result_.width = protocol_.image.width;
        result_.height = protocol_.image.height;
        result_.pixels_per_degree =
            protocol_.display ? pixels_per_degree(protocol_.display->width_mm, protocol_.display->width_px,
                                                  protocol_.display->distance_mm)
                              : default_pixels_per_degree();
        result_.processor = processor_name();
        result_.date = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
        make_views(request);
    }

    AccuracyResult run() {
        // A missing driver is found before the long part.
        context_.emplace(renderer::gl::Context::headless());
        result_.driver = renderer::gl::driver_info().renderer;
        render_truth();
        check();
        time_frames();
        pipelines_.clear();
        measure_closed_forms();
        return std::move(result_);
    }

private:
    static scene::Model load(const AccuracyRequest& request, const study::Protocol& protocol) {
        return stimuli::load_model(protocol, request.model_file);
    }

    void make_views(const AccuracyRequest& request) {
        std::vector<int> azimuths = request.azimuths_deg;
        const auto& known = protocol_.light.azimuths_deg;
        if (azimuths.empty()) {
            azimuths = {std::find(known.begin(), known.end(), 60) != known.end() ? 60 : known.front()};
        }
        const scene::HeadFrame head = stimuli::head_frame(protocol_, model_);
        for (const study::Distance& distance : protocol_.camera.distances) {
            for (const int azimuth : azimuths) {
                views_.push_back({distance, azimuth, stimuli::camera(protocol_, distance, head), {}});
            }
        }
    }

    void render_truth() {
        support::Progress progress("reference", views_.size());
        const auto start = Clock::now();
        renderer::reference::Reference reference(model_, stimuli::look(protocol_));
        for (View& view : views_) {
            const std::string name = fmt::format("reference {} {}", view.distance.name, view.azimuth_deg);
            view.truth = picture_of(
                reference.render(view.camera, stimuli::light(protocol_, view.azimuth_deg), true), name);
            progress.step(name);
        }
        result_.reference_s = seconds_since(start) / static_cast<double>(views_.size());
    }

    passes::Look look_of(const Setting& setting) const {
        study::Protocol protocol = protocol_;
        protocol.skin.profile = setting.profile;
        return stimuli::look(protocol);
    }
    static std::string name_of(const Setting& setting) {
        return fmt::format("{} ({})", passes::shader_name(setting.shader), setting.name);
    }

    /// Make a setting's pipeline, and meet all set-up and compilation with a frame that does not count.
    void make_ready(std::size_t setting) {
        if (!pipelines_[setting]) {
            pipelines_[setting] = std::make_unique<passes::Pipeline>(model_, look_of(settings_[setting]),
                                                                     settings_[setting].methods);
            pipelines_[setting]->render(settings_[setting].shader, views_.front().camera,
                                        stimuli::light(protocol_, views_.front().azimuth_deg));
        }
    }
    /// Give memory back: large images take about a gigabyte a setting.
    void release(std::size_t setting) {
        if (!result_.quick) {
            pipelines_[setting].reset();
        }
    }

    /// Render every setting once in every view, and measure its errors.
    void check() {
        support::Progress progress("checking", settings_.size());
        for (std::size_t at_setting = 0; at_setting < settings_.size(); ++at_setting) {
            const Setting& setting = settings_[at_setting];
            make_ready(at_setting);
            for (const View& view : views_) {
                const std::string name =
                    fmt::format("{} {} {}", name_of(setting), view.distance.name, view.azimuth_deg);
                const scene::Frame frame = pipelines_[at_setting]->render(
                    setting.shader, view.camera, stimuli::light(protocol_, view.azimuth_deg), true);
                const Picture image = picture_of(frame, name);
                check_sound(image, view.truth);
                AccuracyRow row{std::string(passes::shader_name(setting.shader)), setting.name,
                                view.distance.name, view.azimuth_deg};
                row.errors = compare(image, view.truth, result_.pixels_per_degree).errors;
                // no_sss comes first.
                const std::size_t at = result_.rows.size() % views_.size();
                row.worse_than_none =
                    result_.rows.size() >= views_.size() && row.errors.rmse > result_.rows[at].errors.rmse;
                result_.rows.push_back(row);
            }
            release(at_setting);
            progress.step(name_of(setting));
        }
    }

    struct Times {
        std::vector<double> frame_ms, scatter_ms;
    };

    /// Time one frame from the shadow map to the bytes of the finished image.
    void time_frame(std::size_t setting, const View& view, Times& times) {
        passes::Pipeline& pipeline = *pipelines_[setting];
        const scene::Light light =
            stimuli::light(protocol_, view.azimuth_deg + turn_deg * ++frames_[setting]);
        const passes::Costs before = pipeline.costs();
        const auto start = Clock::now();
        const scene::Frame frame = pipeline.render(settings_[setting].shader, view.camera, light);
        times.frame_ms.push_back(1000 * seconds_since(start));
        if (!frame.passes_reused.empty()) {
            throw support::failure("{}: expected a frame made anew, found reused: {}",
                                   name_of(settings_[setting]), fmt::join(frame.passes_reused, ", "));
        }
        double scatter_ms = 0;
        for (const auto& [node, cost] : pipeline.costs()) {
            if (std::find(shared_nodes.begin(), shared_nodes.end(), node) == shared_nodes.end()) {
                const auto earlier = before.find(node);
                scatter_ms += 1000 * (cost.seconds - (earlier == before.end() ? 0 : earlier->second.seconds));
            }
        }
        if (settings_[setting].shader == passes::Shader::no_sss && scatter_ms > 0) {
            throw support::failure("no_sss has no scattering: expected shared nodes alone, found {}",
                                   fmt::join(frame.passes_run, ", "));
        }
        times.scatter_ms.push_back(scatter_ms);
    }

    void time_frames() {
        // Rows stand setting by setting, view by view.
        std::vector<Times> times(result_.rows.size());
        std::vector<std::size_t> settings_order(settings_.size()), views_order(views_.size());
        std::iota(settings_order.begin(), settings_order.end(), std::size_t{0});
        std::iota(views_order.begin(), views_order.end(), std::size_t{0});
        support::Generator generator("bench accuracy order", 1);
        support::Progress progress("timing", static_cast<std::size_t>(result_.rounds));
        for (int round = 1; round <= result_.rounds; ++round) {
            generator.shuffle(settings_order);
            for (const std::size_t setting : settings_order) {
                make_ready(setting);
                generator.shuffle(views_order);
                for (const std::size_t view : views_order) {
                    time_frame(setting, views_[view], times[setting * views_.size() + view]);
                }
                release(setting);
            }
            progress.step(fmt::format("round {} of all settings", round));
        }
        for (std::size_t at = 0; at < times.size(); ++at) {
            AccuracyRow& row = result_.rows[at];
            row.time_ms = median(times[at].frame_ms);
            row.time_spread_ms = median_deviation(times[at].frame_ms);
            row.scatter_ms = median(times[at].scatter_ms);
            row.scatter_spread_ms = median_deviation(times[at].scatter_ms);
        }
    }

    /// The nearest distances, in which kernels cover pixels.
    std::vector<study::Distance> closed_form_distances() const {
        std::vector<study::Distance> distances = protocol_.camera.distances;
        std::sort(distances.begin(), distances.end(),
                  [](const auto& a, const auto& b) { return a.units < b.units; });
        distances.resize(std::min<std::size_t>(distances.size(), 2));
        return distances;
    }

    /// Call with the error of one way to render each scene.
    template <typename Render>
    void add_closed_forms(const ClosedForm& scene, const std::string& shader, const std::string& setting,
                          const Render& render) {
        for (const study::Distance& distance : closed_form_distances()) {
            const scene::Camera camera =
                frontal_camera(stimuli::distance_mm(protocol_, distance), protocol_.camera.fov_deg,
                               protocol_.image.width, protocol_.image.height);
            result_.closed_forms.push_back({scene.name, shader, setting, distance.name,
                                            closed_form_error(scene, camera, render(camera))});
        }
    }

    void measure_closed_forms() {
        const auto scenes = closed_forms(stimuli::look(protocol_).profile);
        support::Progress progress("closed forms", scenes.size());
        for (const ClosedForm& scene : scenes) {
            renderer::reference::Reference reference(scene.model, scene.look);
            add_closed_forms(scene, "reference", "default", [&](const scene::Camera& camera) {
                return reference.render(camera, scene.light, true);
            });
            for (const Setting& setting : settings_) {
                if (result_.quick && setting.name != "default" && setting.name != "published") {
                    continue;
                }
                scene::Look look = scene.look;
                look.profile = look_of(setting).profile;
                passes::Pipeline pipeline(scene.model, look, setting.methods);
                add_closed_forms(scene, std::string(passes::shader_name(setting.shader)), setting.name,
                                 [&](const scene::Camera& camera) {
                                     return pipeline.render(setting.shader, camera, scene.light, true);
                                 });
            }
            progress.step(scene.name);
        }
    }

    study::Protocol protocol_;
    scene::Model model_;
    std::optional<renderer::gl::Context> context_; // outlives the pipelines
    std::vector<Setting> settings_;
    std::vector<View> views_;
    std::vector<std::unique_ptr<passes::Pipeline>> pipelines_; // as settings_; null where not ready
    std::map<std::size_t, int> frames_;                        // timed so far, by setting
    AccuracyResult result_;
};

} // namespace

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

double median_deviation(const std::vector<double>& values) {
    const double middle = median(values);
    std::vector<double> distances;
    for (const double value : values) {
        distances.push_back(std::abs(value - middle));
    }
    return median(distances);
}

AccuracyResult run_accuracy(const AccuracyRequest& request) { return Benchmark(request).run(); }

} // namespace measure
