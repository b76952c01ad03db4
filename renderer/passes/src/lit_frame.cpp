// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "lit_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <renderer/gl/context.h>
#include <renderer/optics/specular.h>

#include "shader_library.h"

namespace renderer::passes {

// material.glsl's table_size
constexpr int specular_table_size = 64;
// Shadows are free of acne at grazing views from 0.2 on.
constexpr float slant_lift = 0.3f;

void begin_rect(const gl::Framebuffer& target, const PixelRect& rect) {
    target.bind();
    glEnable(GL_SCISSOR_TEST);
    glScissor(rect.x, rect.y, rect.width, rect.height);
}

void end_rect() { glDisable(GL_SCISSOR_TEST); }

GLenum light_format() { return gl::runs_on_cpu() ? GL_RGBA32F : GL_RGBA16F; }

LitFrame::LitFrame(int width, int height)
    : diffuse(light_format(), width, height), after_scattering(light_format(), width, height),
      specular(light_format(), width, height),
      depth_mm(GL_R32F, width, height), rect{0, 0, width, height}, skin{} {
    // Kernels that reach over the screen's edge see its mirror image.
    diffuse.filter(GL_LINEAR, GL_LINEAR, GL_MIRRORED_REPEAT);
}

namespace {

/// The table of a Fresnel reflectance. It takes a second to compute, so it is kept for later pipelines.
const std::vector<float>& specular_table(float fresnel_f0) {
    static std::map<float, std::vector<float>> tables;
    std::vector<float>& table = tables[fresnel_f0];
    if (table.empty()) {
        table = optics::specular_albedo_table(specular_table_size, static_cast<double>(fresnel_f0));
    }
    return table;
}

} // namespace

SurfaceLook::SurfaceLook(const Look& look)
    : look_(look), specular_albedo_(GL_R32F, specular_table_size, specular_table_size) {
    const std::vector<float>& table = specular_table(look.fresnel_f0);
    specular_albedo_.upload(GL_RED, GL_FLOAT, table.data());
    specular_albedo_.filter(GL_LINEAR, GL_LINEAR);
}

void SurfaceLook::bind(const gl::Program& program) const {
    specular_albedo_.bind(4);
    program.set("texture_mix", look_.texture_mix);
    program.set("specular_intensity", look_.specular_intensity);
    program.set("fresnel_f0", look_.fresnel_f0);
}

Defines SurfaceLook::defines(const GpuModel::Traits& material, std::size_t beams,
                             const Switches& switches) const {
    const bool all = !switches.specialise;
    return {{"BEAMS", static_cast<int>(beams)},
            {"COLOR_MAP", all || material.color_map ? 1 : 0},
            {"NORMAL_MAP", all || material.normal_map ? 1 : 0},
            {"ROUGHNESS_MAP", all || material.roughness_map ? 1 : 0},
            {"SPECULAR_MAP", all || (material.specular_map && look_.specular_intensity > 0) ? 1 : 0},
            {"SPECULAR", all || look_.specular_intensity > 0 ? 1 : 0},
            {"SCATTERS", material.scatters ? 1 : 0}};
}

void set_camera(const gl::Program& program, const scene::Camera& camera, const scene::Bounds& bounds) {
    program.set("view_from_world", camera.rotation());
    program.set("eye_mm", camera.eye_mm);
    program.set("beyond_mm", std::numeric_limits<float>::max());
    program.set("clip_from_view", camera.projection(bounds));
}

ReversedDepth::ReversedDepth() {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

ReversedDepth::~ReversedDepth() {
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glDepthFunc(GL_LESS);
    glDisable(GL_DEPTH_TEST);
}

LitPass::Samples::Samples(int width, int height, int count, const gl::Texture& depth)
    : resolve(load_screen_program("resolve.frag")), diffuse(GL_RGBA32F, width, height, 1, count),
      rest(GL_RGBA32UI, width, height, 1, count), target({&diffuse, &rest}, &depth) {}

LitPass::LitPass(int width, int height, int samples)
    : sample_count_(samples), programs_("surface.vert", "lit.frag"),
      depth_(GL_DEPTH_COMPONENT32F, width, height, 1, samples), frame_(width, height),
      samples_(samples > 1 ? std::make_unique<Samples>(width, height, samples, depth_) : nullptr),
      target_({&frame_.diffuse, &frame_.after_scattering, &frame_.specular, &frame_.depth_mm},
              samples > 1 ? nullptr : &depth_) {}

/// Clear what an earlier frame left, or new memory holds, outside of the rectangle to be drawn.
void LitPass::clear_outside(const PixelRect& rect) {
    if (rect == frame_.rect) {
        return;
    }
    begin_rect(target_, united(frame_.rect, rect));
    for (int attachment = 0; attachment < 4; ++attachment) {
        target_.clear_color(attachment, glm::vec4(0));
    }
    end_rect();
}

void LitPass::resolve(const PixelRect& rect) {
    clear_outside(rect);
    begin_rect(target_, rect);
    samples_->resolve.use();
    samples_->diffuse.bind(0);
    samples_->rest.bind(1);
    samples_->resolve.set("samples", sample_count_);
    draw_screen();
    end_rect();
}

const LitFrame& LitPass::render(const GpuModel& model, const GpuModel::View& view, const SurfaceLook& look,
                                const scene::Camera& camera, const Light& light,
                                const std::vector<std::size_t>& beams, const ShadowMap& shadow,
                                const Switches& switches) {
    // Light every sample.
    const gl::Framebuffer& target = samples_ ? samples_->target : target_;
    if (!samples_) {
        clear_outside(view.rect);
    }
    begin_rect(target, view.rect);
    if (samples_) {
        target.clear_color(0, glm::vec4(0));
        target.clear_color(1, glm::uvec4(0));
    } else {
        for (int attachment = 0; attachment < 4; ++attachment) {
            target.clear_color(attachment, glm::vec4(0));
        }
    }
    target.clear_depth(0);
    std::set<const gl::Program*> ready;
    maps_read_ = 0;
    {
        const ReversedDepth depth;
        for (const GpuModel::Part& part : view.parts) {
            const std::size_t material = model.meshes()[part.mesh].material;
            Defines defines = look.defines(model.traits(material), beams.size(), switches);
            defines["PACKED"] = samples_ ? 1 : 0;
            maps_read_ += defines["COLOR_MAP"] + defines["NORMAL_MAP"] + defines["ROUGHNESS_MAP"] +
                          defines["SPECULAR_MAP"] + defines["SPECULAR"];
            const gl::Program& program = programs_.with(defines);
            program.use();
            if (ready.insert(&program).second) {
                set_camera(program, camera, model.bounds());
                look.bind(program);
                shadow.bind(program, light, beams);
                program.set("slant_lift", slant_lift);
            }
            model.bind_material(program, material, true);
            model.draw_part(part);
        }
    }
    glDisable(GL_CULL_FACE);
    end_rect();

    if (samples_) {
        resolve(view.rect);
    }
    ++frame_.light_number;
    if (camera_ != camera || !switches.share) {
        ++frame_.depth_number;
        camera_ = camera;
    }
    frame_.level = ShadowMap::level(light);
    frame_.rect = view.rect;
    frame_.skin = view.skin;
    frame_.nearest_mm = view.nearest_mm;
    frame_.farthest_mm = view.farthest_mm;
    return frame_;
}

} // namespace renderer::passes
