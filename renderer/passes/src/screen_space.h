// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <memory>
#include <vector>

#include <renderer/gl/objects.h>
#include <renderer/passes/pipeline.h>

#include "lit_frame.h"
#include "screen_blur.h"
#include "screen_surface.h"

namespace renderer::passes {

/// What of ss_full was left out in a frame.
struct GaussianCounts {
    int run = 0, in_part = 0, skipped = 0; ///< Gaussians: everywhere; where they can be seen; nowhere
    int at_half = 0;                       ///< of those run, at half the resolution
    int passes = 0;                        ///< over the skin
};

/// Subsurface scattering on the screen [Jimenez2009].
class ScreenSpace {
public:
    ScreenSpace(int width, int height, const optics::Profile& profile, const Methods& methods,
                const Switches& switches);

    /// The profile's Gaussians, two 1D passes each, one blurring the result of the other, and their weighted
    /// sum. Begins with narrowest() where its method is the same.
    const gl::Texture& full(const LitFrame& lit, const scene::Camera& camera);
    /// A kernel of few taps in a single pass.
    const gl::Texture& jittered(const LitFrame& lit, const scene::Camera& camera);
    /// The lit frame blurred by the profile's narrowest Gaussian, where that can be seen: once a frame.
    const gl::Texture& narrowest(const LitFrame& lit, const scene::Camera& camera);
    bool holds_narrowest(const LitFrame& lit) const { return narrowest_number_ == lit.light_number; }
    /// Whether full() begins with narrowest(), whatever the settings that do not touch the first Gaussian.
    bool begins_with_narrowest(const LitFrame& lit, const scene::Camera& camera) const;
    /// How often a surface had to be found.
    int surfaces_found() const { return surfaces_found_; }
    /// Of the frame that full() made last.
    const GaussianCounts& counts() const { return counts_; }

private:
    /// Surface and blurs at half the resolution, for wide Gaussians.
    struct Half {
        Half(int width, int height, const FullMethod& method, std::size_t gaussians, bool early_test);
        PixelRect rect; ///< nothing but 0 outside of it
        gl::Program halve, enlarge;
        gl::Texture source, depth_mm;
        gl::Framebuffer target;
        ScreenSurface surface;
        ScreenBlur blur;
    };
    /// Taps turned at random.
    struct Jittered {
        Jittered(const ScreenSurface& surface, int width, int height, const optics::Profile& profile,
                 const JitteredMethod& method, bool early_test);
        const ScreenSurface& surface;
        gl::Program program;
        gl::Texture scattered;
        gl::Framebuffer target;
    };
    ScreenSurface& surface(Foreshortening foreshortening, const Stretch& stretch);
    std::unique_ptr<ScreenBlur> make_blur(const FullMethod& method, std::size_t gaussians);
    bool fits_half(float sigma_mm, float kernel_px_mm, const LitFrame& lit) const;
    float seen_before_mm(float sigma_mm, float kernel_px_mm) const;
    void begin_half(const gl::Texture& source, const LitFrame& lit, const scene::Camera& camera);
    void end_half(const LitFrame& lit);

    int width_, height_;
    Methods methods_;
    Switches switches_;
    optics::Profile profile_;
    std::vector<std::unique_ptr<ScreenSurface>> surfaces_; // those that differ
    // Each made when first needed; narrowest_ is of ts, which no setting of ss_full touches.
    std::unique_ptr<ScreenBlur> full_, narrowest_;
    const gl::Texture* narrowest_light_ = nullptr;
    std::uint64_t narrowest_number_ = 0; // of the lit frame that it was made from
    std::unique_ptr<Half> half_;
    std::unique_ptr<Jittered> jittered_;
    GaussianCounts counts_;
    int surfaces_found_ = 0;
};

} // namespace renderer::passes
