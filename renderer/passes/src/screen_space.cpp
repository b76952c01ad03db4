// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "screen_space.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shader_library.h"

namespace renderer::passes {
namespace {

// A Gaussian below this width changes no pixel that can be told from its neighbours: variance 0.0625 beside
// the 0.083 of the pixel's own square.
constexpr float narrowest_px = 0.25f;
// Halving and enlarging the image adds a variance of 0.25 and 0.75 pixels squared; from this width on, that
// can be taken off the Gaussian.
constexpr float half_resolution_px = 2.5f;
constexpr float half_resolution_variance_px2 = 1;

// Nor may it be much narrower where the skin is farthest.
constexpr float farthest_half_resolution_px = 1.25f;

ScreenGeometry geometry(const LitFrame& lit, const scene::Camera& camera) {
    return {camera.focal_px(),
            0.5f * glm::vec2(static_cast<float>(camera.width), static_cast<float>(camera.height)),
            camera.height, lit.skin, lit.nearest_mm};
}

float first_sigma_mm(const optics::Profile& profile) {
    return static_cast<float>(std::sqrt(profile.gaussians.front().variance_mm2));
}

/// The rectangle at half the resolution, rounded outwards.
PixelRect half_of(const PixelRect& rect) {
    const int right = (rect.x + rect.width + 1) / 2;
    const int top = (rect.y + rect.height + 1) / 2;
    return {rect.x / 2, rect.y / 2, right - rect.x / 2, top - rect.y / 2};
}

} // namespace

ScreenSpace::Half::Half(int width, int height, const FullMethod& method, std::size_t gaussians,
                        bool early_test)
    : rect{0, 0, width, height}, halve(load_screen_program("halve_skin.frag")),
      enlarge(load_screen_program("enlarge_skin.frag")), source(blur_format(method), width, height),
      depth_mm(GL_R32F, width, height), target({&source, &depth_mm}),
      surface(width, height, method.foreshortening, method.stretch),
      blur(surface, width, height, method, gaussians, early_test) {}

ScreenSpace::Jittered::Jittered(const ScreenSurface& its_surface, int width, int height,
                                const optics::Profile& profile, const JitteredMethod& method, bool early_test)
    : surface(its_surface),
      program(load_screen_program("screen_jittered.frag", {{"EARLY_TEST", early_test ? 1 : 0}})),
      scattered(light_format(), width, height), target({&scattered}, &surface.depth_buffer()) {
    target.clear_color(0, glm::vec4(0)); // only skin is drawn
    const bool hable = method.taps == 13;
    std::vector<glm::vec2> offsets_mm;
    std::vector<glm::vec3> tap_weights;
    for (const optics::Tap& tap :
         hable ? optics::hable_kernel() : optics::sunflower_kernel(profile, method.taps)) {
        offsets_mm.push_back(tap.offset * (hable ? method.unit_mm : 1));
        tap_weights.push_back(tap.weight);
    }
    program.set("tap_count", static_cast<int>(offsets_mm.size()));
    program.set("tap_offsets_mm", offsets_mm);
    program.set("tap_weights", tap_weights);
}

ScreenSpace::ScreenSpace(int width, int height, const optics::Profile& profile, const Methods& methods,
                         const Switches& switches)
    : width_(width), height_(height), methods_(methods), switches_(switches), profile_(profile) {}

ScreenSurface& ScreenSpace::surface(Foreshortening foreshortening, const Stretch& stretch) {
    for (const auto& surface : surfaces_) {
        if (surface->is_for(foreshortening, stretch)) {
            return *surface;
        }
    }
    surfaces_.push_back(std::make_unique<ScreenSurface>(width_, height_, foreshortening, stretch));
    return *surfaces_.back();
}

std::unique_ptr<ScreenBlur> ScreenSpace::make_blur(const FullMethod& method, std::size_t gaussians) {
    return std::make_unique<ScreenBlur>(surface(method.foreshortening, method.stretch), width_, height_,
                                        method, gaussians, switches_.early_test);
}

/// The depth from which on a Gaussian is too narrow to be seen.
float ScreenSpace::seen_before_mm(float sigma_mm, float kernel_px_mm) const {
    return switches_.level_of_detail ? sigma_mm * kernel_px_mm / narrowest_px
                                     : std::numeric_limits<float>::infinity();
}

/// Whether a Gaussian is wide enough for half the resolution, at all depths.
bool ScreenSpace::fits_half(float sigma_mm, float kernel_px_mm, const LitFrame& lit) const {
    return methods_.full.half_resolution && sigma_mm * kernel_px_mm / lit.middle_mm() >= half_resolution_px &&
           sigma_mm * kernel_px_mm / lit.farthest_mm >= farthest_half_resolution_px;
}

bool ScreenSpace::begins_with_narrowest(const LitFrame& lit, const scene::Camera& camera) const {
    FullMethod method = methods_.full;
    method.half_resolution = FullMethod{}.half_resolution; // of wide Gaussians
    return method == FullMethod{} && !fits_half(first_sigma_mm(profile_), camera.focal_px(), lit);
}

const gl::Texture& ScreenSpace::full(const LitFrame& lit, const scene::Camera& camera) {
    if (!full_) {
        full_ = make_blur(methods_.full, profile_.gaussians.size());
    }
    counts_ = {};
    ScreenSurface& its_surface = surface(methods_.full.foreshortening, methods_.full.stretch);
    surfaces_found_ += its_surface.find(lit.depth_mm, lit.depth_number, geometry(lit, camera)) ? 1 : 0;
    const gl::Texture& first = begins_with_narrowest(lit, camera) ? narrowest(lit, camera) : lit.diffuse;
    full_->begin(first, &first != &lit.diffuse && ScreenBlur::carries_depth(methods_.full));
    const float kernel_px_mm = its_surface.kernel_px_mm();
    double reached_mm2 = 0; // variance of the source
    ScreenBlur* blur = full_.get();
    for (const optics::Gaussian& gaussian : profile_.gaussians) {
        const auto weight = glm::vec3(gaussian.weight);
        const auto sigma_mm =
            static_cast<float>(std::sqrt(std::max(gaussian.variance_mm2 - reached_mm2, 0.0)));
        const float before_mm = seen_before_mm(sigma_mm, kernel_px_mm);
        const bool is_first = &gaussian == &profile_.gaussians.front();
        const bool is_done = is_first && &first != &lit.diffuse;
        if (is_done || before_mm <= lit.nearest_mm || (is_first && methods_.full.unblurred_first)) {
            blur->skip(weight);
            ++(!is_done ? counts_.skipped : before_mm > lit.farthest_mm ? counts_.run : counts_.in_part);
            reached_mm2 = is_done ? gaussian.variance_mm2 : reached_mm2;
            continue;
        }
        // Where all Gaussians are kept, each has a target of its own, and must fill it.
        const bool everywhere =
            before_mm > lit.farthest_mm || methods_.full.accumulation == Accumulation::weighted_sum;
        float wanted_mm = sigma_mm;
        if (blur == full_.get() && fits_half(sigma_mm, kernel_px_mm, lit)) {
            begin_half(full_->blurred(), lit, camera);
            blur = &half_->blur;
            const float middle_px = sigma_mm * kernel_px_mm / lit.middle_mm();
            wanted_mm *= std::sqrt(1 - half_resolution_variance_px2 / (middle_px * middle_px));
        }
        blur->blur(wanted_mm, sigma_mm * kernel_px_mm / lit.nearest_mm, weight, everywhere ? 0 : before_mm);
        ++(everywhere ? counts_.run : counts_.in_part);
        counts_.at_half += blur == full_.get() ? 0 : 1;
        counts_.passes += 2;
        reached_mm2 = gaussian.variance_mm2;
    }
    if (blur == full_.get()) {
        return full_->sum();
    }
    end_half(lit);
    return full_->blended();
}

void ScreenSpace::begin_half(const gl::Texture& source, const LitFrame& lit, const scene::Camera& camera) {
    if (!half_) {
        half_ = std::make_unique<Half>((width_ + 1) / 2, (height_ + 1) / 2, methods_.full,
                                       profile_.gaussians.size(), switches_.early_test);
    }
    ScreenGeometry half = geometry(lit, camera);
    half.focal_px *= 0.5f;
    half.middle_px *= 0.5f;
    half.height = (half.height + 1) / 2;
    half.rect = half_of(half.rect);
    half.scale = 0.5f;
    half_->halve.use();
    source.bind(0);
    lit.depth_mm.bind(1);
    begin_rect(half_->target, united(half_->rect, half.rect));
    half_->target.clear_color(0, glm::vec4(0));
    half_->target.clear_color(1, glm::vec4(0));
    half_->rect = half.rect;
    glEnable(GL_FRAMEBUFFER_SRGB); // of effect on 8-bit targets alone
    begin_rect(half_->target, half.rect);
    draw_screen();
    end_rect();
    glDisable(GL_FRAMEBUFFER_SRGB);
    surfaces_found_ += half_->surface.find(half_->depth_mm, lit.depth_number, half) ? 1 : 0;
    half_->blur.begin(half_->source);
}

/// Blend what was blurred at half the resolution into the sum.
void ScreenSpace::end_half(const LitFrame& lit) {
    const gl::Texture& sum = half_->blur.sum();
    const gl::Framebuffer& target = full_->sum_target();
    const glm::vec3 share = full_->add_weight(half_->blur.weight());
    half_->enlarge.use();
    half_->enlarge.set("sigma_mm", static_cast<float>(std::sqrt(profile_.gaussians.back().variance_mm2)));
    sum.bind(0);
    lit.depth_mm.bind(1);
    half_->depth_mm.bind(2);
    begin_rect(target, lit.skin);
    glEnable(GL_BLEND);
    glBlendFunc(GL_CONSTANT_COLOR, GL_ONE_MINUS_CONSTANT_COLOR);
    glBlendColor(share.r, share.g, share.b, 1);
    draw_screen();
    glDisable(GL_BLEND);
    end_rect();
}

const gl::Texture& ScreenSpace::jittered(const LitFrame& lit, const scene::Camera& camera) {
    ScreenSurface& its_surface = surface(methods_.jittered.foreshortening, methods_.jittered.stretch);
    if (!jittered_) {
        jittered_ = std::make_unique<Jittered>(its_surface, width_, height_, profile_, methods_.jittered,
                                               switches_.early_test);
    }
    Jittered& jittered = *jittered_;
    surfaces_found_ += its_surface.find(lit.depth_mm, lit.depth_number, geometry(lit, camera)) ? 1 : 0;
    jittered.program.use();
    jittered.surface.bind(jittered.program);
    lit.diffuse.bind(0);
    begin_rect(jittered.target, lit.skin);
    {
        const EarlyTest test(jittered.program, jittered.surface, 0, switches_.early_test);
        draw_screen();
    }
    end_rect();
    return jittered.scattered;
}

const gl::Texture& ScreenSpace::narrowest(const LitFrame& lit, const scene::Camera& camera) {
    if (holds_narrowest(lit)) {
        return *narrowest_light_;
    }
    narrowest_number_ = lit.light_number;
    narrowest_light_ = &lit.diffuse;
    const float sigma_mm = first_sigma_mm(profile_);
    const float before_mm = seen_before_mm(sigma_mm, camera.focal_px());
    if (before_mm <= lit.nearest_mm) {
        return lit.diffuse;
    }
    const FullMethod method;
    if (!narrowest_) {
        narrowest_ = make_blur(method, 1);
    }
    surfaces_found_ += surface(method.foreshortening, method.stretch)
                               .find(lit.depth_mm, lit.depth_number, geometry(lit, camera))
                           ? 1
                           : 0;
    narrowest_->begin(lit.diffuse);
    narrowest_->blur(sigma_mm, sigma_mm * camera.focal_px() / lit.nearest_mm, glm::vec3(1),
                     before_mm > lit.farthest_mm ? 0 : before_mm);
    narrowest_light_ = &narrowest_->blurred();
    return *narrowest_light_;
}

} // namespace renderer::passes
