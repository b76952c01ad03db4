// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <memory>
#include <vector>

#include <renderer/gl/objects.h>
#include <renderer/passes/pipeline.h>

#include "lit_frame.h"
#include "screen_blur.h"

namespace renderer::passes {

/// Subsurface scattering on the screen [Jimenez2009].
class ScreenSpace {
public:
    ScreenSpace(int width, int height, const optics::Profile& profile, const Methods& methods);

    /// The profile's Gaussians, two 1D passes each, one blurring the result of the other, and their weighted
    /// sum.
    const gl::Texture& full(const LitFrame& lit, const scene::Camera& camera);
    /// A kernel of few taps in a single pass.
    const gl::Texture& jittered(const LitFrame& lit, const scene::Camera& camera);
    /// The lit frame blurred by the profile's narrowest Gaussian, where that can be seen.
    const gl::Texture& narrowest(const LitFrame& lit, const scene::Camera& camera);

private:
    /// The same at half the resolution, for wide Gaussians.
    struct Half {
        Half(int width, int height, const FullMethod& method);
        gl::Program halve, enlarge;
        gl::Texture source, depth_mm;
        gl::Framebuffer target;
        ScreenSurface surface;
        ScreenBlur blur;
    };
    void find_surface(const LitFrame& lit, const scene::Camera& camera);
    void begin_half(const gl::Texture& source, const LitFrame& lit, const scene::Camera& camera);
    void end_half(const LitFrame& lit);

    Methods methods_;
    optics::Profile profile_;
    ScreenSurface surface_;
    ScreenBlur blur_;
    std::unique_ptr<Half> half_;
    std::unique_ptr<ScreenBlur> narrowest_; ///< of ts, which no setting of ss_full touches
    gl::Program jittered_;
    gl::Texture scattered_;
    gl::Framebuffer scattered_target_;
};

} // namespace renderer::passes
