// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <renderer/gl/objects.h>
#include <renderer/passes/pipeline.h>

#include "gpu_model.h"
#include "shadow_map.h"

namespace renderer::passes {

/// A rectangle of pixels, origin at the lower left.
struct PixelRect {
    int x = 0, y = 0, width = 0, height = 0;
};

/// Where a camera can see the bounds at all, rounded outwards.
PixelRect visible_rect(const scene::Camera& camera, const scene::Bounds& bounds);

/// The lit frame: what every shader starts from.
struct LitFrame {
    gl::Texture diffuse;          ///< RGBA16F: light about to scatter times matte; matte
    gl::Texture after_scattering; ///< RGBA16F: factor on the scattered light
    gl::Texture specular;         ///< RGBA16F: reflected light; alpha is the coverage of the pixel
    gl::Texture depth_mm;         ///< R32F: linear depth, 0 where there is no skin
    PixelRect rect;               ///< no skin outside

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
    int samples_;
    gl::Program program_, resolve_;
    gl::Texture diffuse_, after_, specular_, depth_mm_, depth_; // one value a sample
    LitFrame frame_;
    gl::Framebuffer samples_target_, target_;
};

/// Set the two matrices of surface.vert.
void set_camera(const gl::Program& program, const scene::Camera& camera, const scene::Bounds& bounds);

} // namespace renderer::passes
