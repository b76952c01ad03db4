// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include <renderer/gl/objects.h>
#include <renderer/passes/pipeline.h>

#include "lit_frame.h"

namespace renderer::passes {

/// Subsurface scattering on the screen [Jimenez2009].
class ScreenSpace {
public:
    ScreenSpace(int width, int height, const optics::Profile& profile, const Methods& methods);

    /// Six Gaussians, two 1D passes each, one blurring the result of the other; then their weighted sum.
    const gl::Texture& full(const LitFrame& lit, const scene::Camera& camera);
    /// Hable's jittered kernel in a single pass.
    const gl::Texture& jittered(const LitFrame& lit, const scene::Camera& camera);

private:
    void find_stretch(const LitFrame& lit, const scene::Camera& camera, const Stretch& stretch);

    Methods methods_;
    std::vector<float> sigmas_mm_;
    std::vector<glm::vec3> weights_;
    gl::Program stretch_, blur_, jittered_, sum_;
    gl::Texture px_per_mm_, half_blurred_, scattered_;
    std::vector<gl::Texture> gaussians_;
    gl::Framebuffer stretch_target_, half_target_, scattered_target_;
    std::vector<gl::Framebuffer> gaussian_targets_;
};

/// The weights of a profile as uniforms.
std::vector<glm::vec3> profile_weights(const optics::Profile& profile);

/// Bind a framebuffer and clear it, then let only the rectangle be drawn until end_rect().
void begin_rect(const gl::Framebuffer& target, const PixelRect& rect);
void end_rect();

} // namespace renderer::passes
