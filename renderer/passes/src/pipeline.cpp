// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <renderer/passes/pipeline.h>

#include <array>
#include <chrono>
#include <utility>

#include <renderer/gl/context.h>
#include <support/error.h>

#include "finish.h"
#include "gpu_model.h"
#include "lit_frame.h"
#include "screen_space.h"
#include "shader_library.h"
#include "shadow_map.h"
#include "texture_space.h"

namespace renderer::passes {
namespace {

constexpr std::array<std::pair<Shader, std::string_view>, 4> names{{{Shader::no_sss, "no_sss"},
                                                                    {Shader::ts, "ts"},
                                                                    {Shader::ss_jittered, "ss_jittered"},
                                                                    {Shader::ss_full, "ss_full"}}};

int driver_limit(GLenum name) {
    GLint limit = 0;
    glGetIntegerv(name, &limit);
    return limit;
}

void require_limit(const char* what, int wanted, GLenum name) {
    const int limit = driver_limit(name);
    if (wanted > limit) {
        throw support::input_error("{}: expected at most {}, which this OpenGL driver allows, found {}", what,
                                   limit, wanted);
    }
}

} // namespace

std::string_view shader_name(Shader shader) {
    for (const auto& [value, name] : names) {
        if (value == shader) {
            return name;
        }
    }
    return {};
}

std::optional<Shader> shader_of(std::string_view wanted) {
    for (const auto& [value, name] : names) {
        if (name == wanted) {
            return value;
        }
    }
    return std::nullopt;
}

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
    // What the nodes hold now.
    std::optional<Light> shadow_light, irradiance_light;
    std::optional<std::pair<scene::Camera, Light>> lit_view;
    Costs costs;
    std::vector<std::string> warnings;
    std::vector<std::string> run, reused; // by the frame being rendered

    State(const scene::Model& model_, const Look& look_, const Methods& methods_, const Switches& switches_)
        : source(model_), look(look_), methods(methods_), switches(switches_), model(model_, look_.roughness),
          surface_look(look_) {}

    /// Let no node's result outlive its frame, if so asked.
    void forget() {
        if (!switches.share) {
            shadow_light.reset();
            irradiance_light.reset();
            lit_view.reset();
        }
    }

    /// Run one node to its end and add up what it took.
    template <typename Work>
    void timed(const char* node, const Work& work) {
        const auto start = std::chrono::steady_clock::now();
        glBindVertexArray(no_vertices.id());
        work();
        glFinish();
        gl::check_errors(node);
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        costs[node].seconds += elapsed.count();
        ++costs[node].runs;
        run.emplace_back(node);
    }

    void prepare_size(int width, int height) {
        if (finish && lit->frame().diffuse.width() == width && lit->frame().diffuse.height() == height) {
            return;
        }
        require_limit("image width", width, GL_MAX_TEXTURE_SIZE);
        require_limit("image height", height, GL_MAX_TEXTURE_SIZE);
        timed("set-up", [&] {
            finish.reset(); // so that a failure below is met again
            screen_space.reset();
            texture_space.reset();
            lit_view.reset();
            irradiance_light.reset();
            lit = std::make_unique<LitPass>(width, height, look.samples);
            finish = std::make_unique<Finish>(width, height, look);
        });
    }

    void prepare_screen_space(const scene::Camera& camera) {
        if (!screen_space) {
            timed("set-up", [&] {
                screen_space =
                    std::make_unique<ScreenSpace>(camera.width, camera.height, look.profile, methods);
            });
        }
    }

    void light_view(const scene::Camera& camera, const Light& light) {
        if (shadow_light != light) {
            timed("shadow map", [&] { shadow.render(model, light); });
            shadow_light = light;
        } else {
            reused.emplace_back("shadow map");
        }
        if (!lit_view || lit_view->first != camera || lit_view->second != light) {
            timed("lit frame", [&] { lit->render(model, surface_look, camera, light, shadow); });
            lit_view.emplace(camera, light);
        } else {
            reused.emplace_back("lit frame");
        }
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

    const gl::Texture& scattered(Shader shader, const scene::Camera& camera, const Light& light) {
        const LitFrame& frame = lit->frame();
        const gl::Texture* result = &frame.diffuse;
        if (shader == Shader::ss_full || shader == Shader::ss_jittered) {
            if (shader == Shader::ss_full) {
                timed("ss_full", [&] { result = &screen_space->full(frame, camera); });
            } else {
                timed("ss_jittered", [&] { result = &screen_space->jittered(frame, camera); });
            }
        } else if (shader == Shader::ts) {
            unwrap(camera);
            if (irradiance_light != light) {
                timed("ts irradiance and blurs",
                      [&] { texture_space->light(model, surface_look, light, shadow); });
                irradiance_light = light;
            } else {
                reused.emplace_back("ts irradiance and blurs");
            }
            const gl::Texture* narrowest = &frame.diffuse;
            if (!methods.ts.unblurred_first) {
                timed("ts narrowest", [&] { narrowest = &screen_space->narrowest(frame, camera); });
            }
            timed("ts gather", [&] { result = &texture_space->gather(model, frame, *narrowest, camera); });
        }
        return *result;
    }
};

Pipeline::Pipeline(const scene::Model& model, const Look& look, const Methods& methods,
                   const Switches& switches) {
    gl::require_opengl_45();
    require_limit("samples", look.samples, GL_MAX_COLOR_TEXTURE_SAMPLES);
    require_limit("samples", look.samples, GL_MAX_DEPTH_TEXTURE_SAMPLES);
    require_limit("ts map size", methods.ts.map_size, GL_MAX_TEXTURE_SIZE);
    state_ = std::make_unique<State>(model, look, methods, switches);
}

Pipeline::~Pipeline() = default;

void Pipeline::prepare(Shader shader, const scene::Camera& camera, const Light& light) {
    require_limit("shadow map size", light.shadow_map_size, GL_MAX_TEXTURE_SIZE);
    state_->prepare_size(camera.width, camera.height);
    if (shader != Shader::no_sss) {
        state_->prepare_screen_space(camera);
    }
    if (shader == Shader::ts) {
        state_->unwrap(camera);
    }
}

Frame Pipeline::render(Shader shader, const scene::Camera& camera, const Light& light, bool with_linear) {
    state_->run.clear();
    state_->reused.clear();
    prepare(shader, camera, light);
    state_->forget();
    state_->light_view(camera, light);
    const gl::Texture& scattered = state_->scattered(shader, camera, light);
    Frame frame;
    state_->timed("composite", [&] { state_->finish->composite(scattered, state_->lit->frame()); });
    state_->timed("bloom", [&] { state_->finish->bloom(); });
    state_->timed("output and read back", [&] { frame = state_->finish->output(with_linear); });
    frame.passes_run = state_->run;
    frame.passes_reused = state_->reused;
    return frame;
}

const Costs& Pipeline::costs() const { return state_->costs; }
const std::vector<std::string>& Pipeline::warnings() const { return state_->warnings; }

} // namespace renderer::passes
