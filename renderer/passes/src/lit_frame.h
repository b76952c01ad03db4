// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include <renderer/gl/objects.h>
#include <renderer/passes/pipeline.h>

#include "gpu_model.h"
#include "program_variants.h"
#include "shadow_map.h"

namespace renderer::passes {

/// The format of textures that carry light: floats of 32 bits on a CPU, which would have to convert half
/// floats, and may cut them off (llvmpipe does); half floats on a GPU, where they save bandwidth.
GLenum light_format();

/// The lit frame: what every shader starts from.
struct LitFrame {
    gl::Texture diffuse;          ///< light about to scatter times matte; matte
    gl::Texture after_scattering; ///< factor on the scattered light
    gl::Texture specular;         ///< reflected light; alpha is the coverage of the pixel
    gl::Texture depth_mm;         ///< R32F: linear depth, 0 where there is no skin
    PixelRect rect;               ///< nothing outside: all is 0
    PixelRect skin;               ///< no skin outside; within `rect`
    glm::vec3 level{1}; ///< what the light of this frame is to be multiplied with, see ShadowMap::level()
    float nearest_mm = 1, farthest_mm = 1; ///< depths of the skin; above 0
    // What is made from the frame can be kept while these stay: the light, and the depth, which any light
    // leaves.
    std::uint64_t light_number = 0, depth_number = 0;

    float middle_mm() const { return 0.5f * (nearest_mm + farthest_mm); }

    LitFrame(int width, int height);
};

/// Uniforms that come from the look, shared by all programs that include material.glsl.
class SurfaceLook {
public:
    explicit SurfaceLook(const Look& look);
    void bind(const gl::Program& program) const;
    /// What material.glsl is to leave out for a material under so many beams.
    Defines defines(const GpuModel::Traits& material, std::size_t beams, const Switches& switches) const;

private:
    Look look_;
    gl::Texture specular_albedo_;
};

/// Renders lit frames of one size.
class LitPass {
public:
    LitPass(int width, int height, int samples);
    /// What a camera, given relative to the model's origin, sees of the model under those beams of the light.
    const LitFrame& render(const GpuModel& model, const GpuModel::View& view, const SurfaceLook& look,
                           const scene::Camera& camera, const Light& light,
                           const std::vector<std::size_t>& beams, const ShadowMap& shadow,
                           const Switches& switches);
    const LitFrame& frame() const { return frame_; }
    /// How many maps the materials of the frame rendered last read.
    int maps_read() const { return maps_read_; }

private:
    /// One value a sample, where a pixel has several.
    struct Samples {
        Samples(int width, int height, int count, const gl::Texture& depth);
        gl::Program resolve;
        gl::Texture diffuse, rest;
        gl::Framebuffer target;
    };
    void clear_outside(const PixelRect& rect);
    void resolve(const PixelRect& rect);

    int sample_count_;
    int maps_read_ = 0;
    std::optional<scene::Camera> camera_; // of the depth
    ProgramVariants programs_;
    gl::Texture depth_; // of the samples
    LitFrame frame_;
    std::unique_ptr<Samples> samples_;
    gl::Framebuffer target_;
};

/// Set what surface.vert needs to know of the camera, given relative to the model's origin.
void set_camera(const gl::Program& program, const scene::Camera& camera, const scene::Bounds& bounds);

/// Bind a framebuffer and let only the rectangle be drawn or cleared until end_rect().
void begin_rect(const gl::Framebuffer& target, const PixelRect& rect);
void end_rect();

/// While it lives, drawing keeps what is nearest by the reversed depth of scene::Camera::projection().
/// Targets are cleared to a depth of 0.
class ReversedDepth {
public:
    ReversedDepth();
    ~ReversedDepth();
    ReversedDepth(const ReversedDepth&) = delete;
    ReversedDepth& operator=(const ReversedDepth&) = delete;
};

} // namespace renderer::passes
