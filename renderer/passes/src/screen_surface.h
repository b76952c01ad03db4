// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include <renderer/gl/objects.h>
#include <renderer/passes/pipeline.h>

#include "lit_frame.h"
#include "shader_library.h"

namespace renderer::passes {

/// Where a camera's pixels lie, at the resolution of a pass.
struct ScreenGeometry {
    float focal_px = 1;
    glm::vec2 middle_px{0};
    int height = 0;
    PixelRect rect{};     ///< no skin outside
    float nearest_mm = 1; ///< no skin before this depth
    float scale = 1;      ///< pixels of the pass per pixel of the image

    bool operator==(const ScreenGeometry&) const = default;
};

/// How deep the skin is at each pixel, which plane it lies in, and how kernels look there: what all passes of
/// a method need to know, found once a camera.
class ScreenSurface {
public:
    ScreenSurface(int width, int height, Foreshortening foreshortening, const Stretch& stretch);
    /// `number` changes with what `depth_mm` holds: what was found last is kept while both arguments stay.
    /// Whether it had to be found.
    bool find(const gl::Texture& depth_mm, std::uint64_t number, const ScreenGeometry& geometry);
    bool is_for(Foreshortening foreshortening, const Stretch& stretch) const {
        return foreshortening == foreshortening_ && stretch == stretch_;
    }
    /// Bind the maps to units 1 and 2, the depth to 5, and set the uniforms of screen_surface.glsl.
    void bind(const gl::Program& program) const;
    const ScreenGeometry& geometry() const { return geometry_; }
    /// Pixels per millimetre of a kernel's width at a depth of 1 mm.
    float kernel_px_mm() const;
    /// The skin's depth as a depth buffer: 0 where there is none, else the more the nearer.
    const gl::Texture& depth_buffer() const { return depth_buffer_; }
    /// The value that the depth buffer has at a depth.
    float buffered(float depth_mm) const;

private:
    Foreshortening foreshortening_;
    Stretch stretch_;
    gl::Program program_;
    gl::Texture shapes_, planes_, depth_buffer_;
    gl::Framebuffer target_;
    ScreenGeometry geometry_;
    std::uint64_t number_ = 0; ///< of the depth; 0: none yet
    const gl::Texture* depth_mm_ = nullptr;
};

/// While it lives, draw_screen() draws only pixels of a target with the surface's depth buffer that show skin
/// before a depth (millimetres, 0: any), as long as `on`.
class EarlyTest {
public:
    EarlyTest(const gl::Program& program, const ScreenSurface& surface, float before_mm, bool on);
    ~EarlyTest();
    EarlyTest(const EarlyTest&) = delete;
    EarlyTest& operator=(const EarlyTest&) = delete;

private:
    bool on_;
};

} // namespace renderer::passes
