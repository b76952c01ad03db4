// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <renderer/gl/objects.h>
#include <renderer/passes/pipeline.h>

#include "gpu_model.h"

namespace renderer::passes {

/// What the light sees of a model, for lighting it with shadows. One render a light.
/// Beside it lie the depth's bounds around each block of texels, which spare most points the filter.
class ShadowMap {
public:
    ShadowMap();
    /// Render the model's depth from the light, its frustum fitted around the model.
    void render(const GpuModel& model, const Light& light);
    /// Bind the map to unit 3 and set what material.glsl needs of light and shadow.
    /// The light itself is given divided by level(), so that light of any strength fits half floats.
    void bind(const gl::Program& program, const Light& light) const;
    /// The radiance of a white surface that faces light and ambient light, per channel; 1 where there is
    /// none.
    static glm::vec3 level(const Light& light);

private:
    void find_bounds();

    gl::Program program_, blocks_program_, bounds_program_;
    gl::Texture depth_, depth_values_, blocks_, bounds_;
    float sigma_texels_ = 0;
    glm::mat4 light_from_world_{1};
    float texel_mm_ = 1;
};

} // namespace renderer::passes
