// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <renderer/gl/objects.h>
#include <renderer/passes/pipeline.h>

#include "gpu_model.h"

namespace renderer::passes {

/// What the light sees of a model, for lighting it with shadows. One render a light.
class ShadowMap {
public:
    ShadowMap();
    /// Render the model's depth from the light, its frustum fitted around the model.
    void render(const GpuModel& model, const Light& light);
    /// Bind the map to unit 3 and set what material.glsl needs of light and shadow.
    void bind(const gl::Program& program, const Light& light) const;

private:
    gl::Program program_;
    gl::Texture depth_;
    glm::mat4 light_from_world_{1};
    float texel_mm_ = 1;
};

} // namespace renderer::passes
