// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <renderer/passes/pipeline.h>

#include <algorithm>
#include <chrono>
#include <map>

#include <renderer/gl/context.h>
#include <support/error.h>

#include "driver_limit.h"
#include "finish.h"
#include "gpu_model.h"
#include "lit_frame.h"
#include "screen_space.h"
#include "shader_library.h"
#include "shadow_map.h"
#include "texture_space.h"

namespace renderer::passes {

struct Pipeline::State {
    const scene::Model& source;
    Look look;
    Methods methods;
    Switches switches;
    GpuModel model;
    SurfaceLook surface_look;
    gl::VertexArray no_vertices; // for draws that make their own
    ShadowMap shadow;
    // Made when first needed, for the image size then asked for.
    std::unique_ptr<LitPass> lit;
    std::unique_ptr<ScreenSpace> screen_space;
    std::unique_ptr<TextureSpace> texture_space;
    std::unique_ptr<Finish> finish;
    glm::ivec2 size{0};
    bool time_nodes = true;
    // What the nodes hold now.
    std::optional<std::pair<scene::Camera, Light>> irradiance_view; // any camera, if not culled
    std::optional<std::pair<scene::Camera, Light>> lit_view;
    GpuModel::View view;
    Costs costs;
    std::vector<std::string> warnings;
    // Of the frame being drawn:
    std::vector<std::string> run, reused, skipped;
    std::map<std::string, long long> counts;

    State(const scene::Model& model_, const Look& look_, const Methods& methods_, const Switches& switches_)
        : source(model_), look(look_), methods(methods_), switches(switches_), model(model_, look_.roughness),
          surface_look(look_) {}

    /// Run one node, to its end if times are wanted, and add up what it took.
    template <typename Work>
    void timed(const char* node, const Work& work) {
        const auto start = std::chrono::steady_clock::now();
        glBindVertexArray(no_vertices.id());
        work();
        if (time_nodes) {
            glFinish();
        }
        gl::check_errors(node);
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        costs[node].seconds += elapsed.count();
        ++costs[node].runs;
        run.emplace_back(node);
    }

    void prepare_size(const glm::ivec2& wanted) {
        if (finish && size == wanted) {
            return;
        }
        require_limit("image width", wanted.x, GL_MAX_TEXTURE_SIZE);
        require_limit("image height", wanted.y, GL_MAX_TEXTURE_SIZE);
        timed("set-up", [&] {
            finish.reset(); // so that a failure below is met again
            screen_space.reset();
            texture_space.reset();
            forget();
            lit = std::make_unique<LitPass>(wanted.x, wanted.y, look.samples);
            finish = std::make_unique<Finish>(wanted.x, wanted.y, look);
            screen_space = std::make_unique<ScreenSpace>(wanted.x, wanted.y, look.profile, methods, switches);
            size = wanted;
        });
    }

    void forget() {
        irradiance_view.reset();
        lit_view.reset();
        shadow.forget();
    }

    /// The beams of a light that are not dark.
    static std::vector<std::size_t> bright_beams(const Light& light) {
        const std::vector<scene::Beam> all = light.beams();
        std::vector<std::size_t> beams;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (all[i].irradiance != glm::vec3(0)) {
                beams.push_back(i);
            }
        }
        return beams;
    }

    void see_shadows(const Light& light, const std::vector<std::size_t>& beams) {
        if (beams.empty()) {
            return;
        }
        if (shadow.holds(light, beams)) {
            const auto is_shadow = [](const std::string& node) { return node == "shadow map"; };
            if (std::none_of(run.begin(), run.end(), is_shadow) &&
                std::none_of(reused.begin(), reused.end(), is_shadow)) {
                reused.emplace_back("shadow map");
            }
            return;
        }
        int rendered = 0;
        timed("shadow map", [&] { rendered = shadow.render(model, light, beams); });
        counts["shadow maps"] += rendered;
    }

    /// The beams that light something in view, if dark ones may be skipped.
    std::vector<std::size_t> beams_in_view(const Light& light) {
        std::vector<std::size_t> beams = bright_beams(light);
        const std::size_t bright = beams.size();
        if (switches.skip_unlit) {
            const std::vector<scene::Beam> all = light.beams();
            std::erase_if(beams, [&](std::size_t i) { return !model.may_light(view, all[i].direction); });
        }
        if (beams.size() < bright) {
            skipped.push_back(
                fmt::format("{} of {} lights: they light nothing in view", bright - beams.size(), bright));
        }
        return beams;
    }

    void light_view(const scene::Camera& camera, const Light& light) {
        if (lit_view && lit_view->first == camera && lit_view->second == light) {
            reused.emplace_back("shadow map");
            reused.emplace_back("lit frame");
            return;
        }
        const std::vector<std::size_t> beams = beams_in_view(light);
        see_shadows(light, beams);
        timed("lit frame", [&] {
            lit->render(model, view, surface_look, model.seen_by(camera), light, beams, shadow, switches);
        });
        lit_view.emplace(camera, light);
        counts["triangles"] = view.triangles - (switches.cull ? view.culled : 0);
        counts["maps read"] = lit->maps_read();
        counts["triangles culled"] = switches.cull ? view.culled : 0;
    }

    /// Make the maps of texture space, once.
    void unwrap(const scene::Camera& camera) {
        if (!texture_space) {
            timed("ts unwrapping", [&] {
                texture_space = std::make_unique<TextureSpace>(source, model, look.profile, methods,
                                                               camera.width, camera.height, look.samples);
            });
            warnings = texture_space->warnings();
        }
    }

    void count_maps(const TextureSpaceCounts& maps) {
        counts["uv layouts"] = maps.layouts;
        counts["maps"] = maps.maps_lit;
        counts["maps skipped"] = maps.maps_skipped;
        counts["texels"] = maps.texels_lit;
        counts["texels skipped"] = maps.texels_skipped;
        counts["smallest map"] = maps.sizes.empty() ? 0 : *maps.sizes.begin();
        if (maps.maps_skipped > 0) {
            skipped.push_back(fmt::format("{} irradiance maps: out of view", maps.maps_skipped));
        }
        if (maps.texels_skipped > 0) {
            skipped.push_back(fmt::format("{} texels of irradiance maps: neither seen nor near what is seen",
                                          maps.texels_skipped));
        }
    }

    const gl::Texture& narrowest_gaussian(const LitFrame& frame, const scene::Camera& camera) {
        if (screen_space->holds_narrowest(frame)) {
            reused.emplace_back("narrowest Gaussian");
        } else {
            timed("narrowest Gaussian", [&] { screen_space->narrowest(frame, camera); });
            counts["blur passes"] += &screen_space->narrowest(frame, camera) == &frame.diffuse ? 0 : 2;
        }
        return screen_space->narrowest(frame, camera);
    }

    const gl::Texture& gathered(const scene::Camera& camera, const Light& light) {
        const LitFrame& frame = lit->frame();
        unwrap(camera);
        const std::pair wanted{methods.ts.culled ? camera : scene::Camera{}, light};
        if (irradiance_view != wanted) {
            const std::vector<std::size_t> beams = bright_beams(light);
            see_shadows(light, beams);
            timed("ts irradiance and blurs", [&] {
                texture_space->light(model, view, camera, surface_look, light, beams, shadow, switches);
            });
            irradiance_view = wanted;
            count_maps(texture_space->counts());
        } else {
            reused.emplace_back("ts irradiance and blurs");
        }
        const gl::Texture& narrowest =
            methods.ts.unblurred_first ? frame.diffuse : narrowest_gaussian(frame, camera);
        const gl::Texture* result = nullptr;
        timed("ts gather",
              [&] { result = &texture_space->gather(model, view, frame, narrowest, model.seen_by(camera)); });
        return *result;
    }

    const gl::Texture& blurred(const LitFrame& frame, const scene::Camera& camera) {
        if (screen_space->begins_with_narrowest(frame, camera)) {
            narrowest_gaussian(frame, camera);
        }
        const gl::Texture* result = nullptr;
        timed("ss_full", [&] { result = &screen_space->full(frame, camera); });
        const GaussianCounts& gaussians = screen_space->counts();
        counts["gaussians"] = gaussians.run;
        counts["gaussians in part"] = gaussians.in_part;
        counts["gaussians at half resolution"] = gaussians.at_half;
        counts["gaussians skipped"] = gaussians.skipped;
        counts["blur passes"] += gaussians.passes;
        if (gaussians.skipped > 0) {
            skipped.push_back(
                fmt::format("Gaussians narrower than can be seen at this distance: {}", gaussians.skipped));
        }
        if (gaussians.in_part > 0) {
            skipped.push_back(
                fmt::format("Gaussians where the skin is too far to see them: {}", gaussians.in_part));
        }
        return *result;
    }

    const gl::Texture& scattered(Shader shader, const scene::Camera& camera, const Light& light) {
        const LitFrame& frame = lit->frame();
        if (shader == Shader::no_sss || frame.skin.empty()) {
            if (shader != Shader::no_sss) {
                skipped.emplace_back("scattering: no skin in view");
            }
            return frame.diffuse;
        }
        if (shader == Shader::ts) {
            return gathered(camera, light);
        }
        if (shader == Shader::ss_full) {
            return blurred(frame, camera);
        }
        const gl::Texture* result = nullptr;
        timed("ss_jittered", [&] { result = &screen_space->jittered(frame, camera); });
        return *result;
    }

    void finish_frame(const gl::Texture& scattered_light, const scene::Camera& camera, bool with_linear) {
        timed("composite", [&] { finish->composite(scattered_light, lit->frame()); });
        if (finish->has_depth_of_field()) {
            timed("depth of field", [&] { finish->depth_of_field(lit->frame(), camera); });
        }
        if (finish->blooms()) {
            timed("bloom", [&] { finish->bloom(); });
        } else {
            skipped.emplace_back("bloom: its strength is 0");
        }
        timed("output", [&] { finish->output(with_linear); });
    }

    void draw(Shader shader, const scene::Camera& camera, const Light& light, bool with_linear) {
        if (!switches.share) {
            forget();
        }
        view = model.view(model.seen_by(camera), switches);
        const long long whole = static_cast<long long>(camera.width) * camera.height;
        counts["pixels"] = static_cast<long long>(view.rect.width) * view.rect.height;
        counts["pixels outside"] = whole - counts["pixels"];
        if (view.rect.empty()) {
            skipped.emplace_back("everything: the model is out of view");
            timed("output", [&] { finish->output_background(with_linear); });
            return;
        }
        light_view(camera, light);
        const int surfaces = screen_space->surfaces_found();
        finish_frame(scattered(shader, camera, light), camera, with_linear);
        counts["surfaces"] = screen_space->surfaces_found() - surfaces;
    }
};

Pipeline::Pipeline(const scene::Model& model, const Look& look, const Methods& methods,
                   const Switches& switches) {
    gl::require_opengl_45();
    require_limit("samples", look.samples, GL_MAX_COLOR_TEXTURE_SAMPLES);
    require_limit("samples", look.samples, GL_MAX_DEPTH_TEXTURE_SAMPLES);
    require_limit("samples", look.samples, GL_MAX_INTEGER_SAMPLES); // packed_sample.glsl
    require_limit("ts map size", methods.ts.map_size, GL_MAX_TEXTURE_SIZE);
    state_ = std::make_unique<State>(model, look, methods, switches);
}

Pipeline::~Pipeline() = default;

void Pipeline::prepare(Shader shader, const scene::Camera& camera, const Light& light) {
    require_limit("shadow map size", light.shadow_map_size, GL_MAX_TEXTURE_SIZE);
    if (light.further.size() >= scene::most_beams) {
        throw support::input_error("lights: expected at most {}, found {}", scene::most_beams,
                                   light.further.size() + 1);
    }
    state_->prepare_size({camera.width, camera.height});
    if (shader == Shader::ts && state_->model.has_skin()) {
        state_->unwrap(camera);
    }
}

void Pipeline::draw(Shader shader, const scene::Camera& camera, const Light& light, bool with_linear) {
    state_->run.clear();
    state_->reused.clear();
    state_->skipped.clear();
    state_->counts.clear();
    prepare(shader, camera, light);
    state_->draw(shader, camera, light, with_linear);
}

Frame Pipeline::read(bool with_linear) {
    Frame frame;
    state_->timed("read back", [&] { frame = state_->finish->read(with_linear); });
    frame.passes_run = state_->run;
    frame.passes_reused = state_->reused;
    frame.passes_skipped = state_->skipped;
    frame.counts = state_->counts;
    return frame;
}

Frame Pipeline::render(Shader shader, const scene::Camera& camera, const Light& light, bool with_linear) {
    draw(shader, camera, light, with_linear);
    return read(with_linear);
}

void Pipeline::time_nodes(bool wanted) { state_->time_nodes = wanted; }
const Costs& Pipeline::costs() const { return state_->costs; }
const std::vector<std::string>& Pipeline::warnings() const { return state_->warnings; }

} // namespace renderer::passes
