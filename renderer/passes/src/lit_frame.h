// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <memory>

#include <renderer/gl/objects.h>
#include <renderer/passes/pipeline.h>

#include "gpu_model.h"
#include "shadow_map.h"

namespace renderer::passes {

/// A rectangle of pixels, origin at the lower left.
struct PixelRect {
    int x = 0, y = 0, width = 0, height = 0;

    bool operator==(const PixelRect&) const = default;
};

/// Where a camera can see the bounds at all, rounded outwards.
PixelRect visible_rect(const scene::Camera& camera, const scene::Bounds& bounds);

/// The format of textures that carry light: floats of 32 bits on a CPU, which would have to convert half
/// floats, and may cut them off (llvmpipe does); half floats on a GPU, where they save bandwidth.
GLenum light_format();

/// The lit frame: what every shader starts from.
struct LitFrame {
    gl::Texture diffuse;          ///< light about to scatter times matte; matte
    gl::Texture after_scattering; ///< factor on the scattered light
    gl::Texture specular;         ///< reflected light; alpha is the coverage of the pixel
    gl::Texture depth_mm;         ///< R32F: linear depth, 0 where there is no skin
    PixelRect rect;               ///< no skin outside
    glm::vec3 level{1};   ///< what the light of this frame is to be multiplied with, see ShadowMap::level()
    float nearest_mm = 1; ///< no skin before this depth; above 0
    float middle_mm = 1;  ///< depth of the middle of the model's bounds; above 0

    LitFrame(int width, int height);
};

/// Uniforms that come from the look, shared by all programs that include material.glsl.
class SurfaceLook {
public:
    explicit SurfaceLook(const Look& look);
    void bind(const gl::Program& program) const;

private:
    Look look_;
    gl::Texture specular_albedo_;
};

/// Renders lit frames of one size.
class LitPass {
public:
    LitPass(int width, int height, int samples);
    const LitFrame& render(const GpuModel& model, const SurfaceLook& look, const scene::Camera& camera,
                           const Light& light, const ShadowMap& shadow);
    const LitFrame& frame() const { return frame_; }

private:
    /// One value a sample, where a pixel has several.
    struct Samples {
        Samples(int width, int height, int count, const gl::Texture& depth);
        gl::Program resolve;
        gl::Texture diffuse, after, specular, depth_mm;
        gl::Framebuffer target;
    };
    void resolve();

    int sample_count_;
    gl::Program program_;
    gl::Texture depth_; // of the samples
    LitFrame frame_;
    std::unique_ptr<Samples> samples_;
    gl::Framebuffer target_;
};

/// Set what surface.vert needs to know of the camera, given relative to the model's origin.
void set_camera(const gl::Program& program, const scene::Camera& camera, const scene::Bounds& bounds);

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
