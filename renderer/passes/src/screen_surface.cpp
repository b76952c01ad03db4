// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "screen_surface.h"

#include <algorithm>

namespace renderer::passes {
namespace {

// A kernel's step never exceeds this share of the image's height, however near the camera comes.
constexpr float widest_step = 0.25f;

} // namespace

ScreenSurface::ScreenSurface(int width, int height, Foreshortening foreshortening, const Stretch& stretch)
    : foreshortening_(foreshortening), stretch_(stretch),
      program_(load_screen_program(
          "screen_surface.frag",
          {{"PUBLISHED_FORESHORTENING", foreshortening == Foreshortening::published ? 1 : 0}})),
      shapes_(GL_RGBA32F, width, height), planes_(GL_RGBA32F, width, height),
      depth_buffer_(GL_DEPTH_COMPONENT32F, width, height), target_({&shapes_, &planes_}, &depth_buffer_) {}

float ScreenSurface::kernel_px_mm() const {
    return stretch_.alpha ? *stretch_.alpha * published_depth_unit_mm * geometry_.scale : geometry_.focal_px;
}

float ScreenSurface::buffered(float depth_mm) const {
    return std::min(geometry_.nearest_mm / depth_mm, 1.0f);
}

bool ScreenSurface::find(const gl::Texture& depth_mm, std::uint64_t number, const ScreenGeometry& geometry) {
    if (number_ == number && depth_mm_ == &depth_mm && geometry_ == geometry) {
        return false;
    }
    number_ = number;
    geometry_ = geometry;
    depth_mm_ = &depth_mm;
    // Physically, a width at depth d covers focal_px / d pixels, and a surface tilted by dz/dx is
    // foreshortened by about 1 / (1 + |dz/dx|), dz/dx being the gradient per pixel times focal_px / d: so
    // alpha and beta of Eqs. 2-3 are both focal_px. The published alpha is in the unit that makes 11 physical
    // for the 2009 stimuli. A given alpha or beta is in pixels of the image.
    program_.use();
    program_.set("focal_px", geometry.focal_px);
    program_.set("middle_px", geometry.middle_px);
    program_.set("kernel_px_mm", kernel_px_mm());
    program_.set("beta_px", stretch_.beta ? *stretch_.beta * geometry.scale : geometry.focal_px);
    program_.set("nearest_mm", geometry.nearest_mm);
    depth_mm.bind(0);
    begin_rect(target_, geometry.rect);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    draw_screen();
    glDepthFunc(GL_LESS);
    glDisable(GL_DEPTH_TEST);
    end_rect();
    return true;
}

void ScreenSurface::bind(const gl::Program& program) const {
    program.set("kernel_px_mm", kernel_px_mm());
    program.set("widest_px", widest_step * static_cast<float>(geometry_.height));
    shapes_.bind(1);
    planes_.bind(2);
    depth_mm_->bind(5);
}

EarlyTest::EarlyTest(const gl::Program& program, const ScreenSurface& surface, float before_mm, bool on)
    : on_(on) {
    program.set("draw_depth", on && before_mm > 0 ? surface.buffered(before_mm) : 0.0f);
    program.set("before_mm", before_mm);
    if (on_) {
        glEnable(GL_DEPTH_TEST);
        glDepthMask(GL_FALSE);
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    }
}

EarlyTest::~EarlyTest() {
    if (on_) {
        glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
        glDepthMask(GL_TRUE);
        glDisable(GL_DEPTH_TEST);
    }
}

} // namespace renderer::passes
