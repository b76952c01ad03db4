// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <vector>

#include <renderer/gl/objects.h>
#include <renderer/passes/pipeline.h>

#include "gpu_model.h"

namespace renderer::passes {

/// What the lights see of a model, for lighting it with shadows: a layer for each beam, rendered once.
/// Beside them lie the depth's bounds around each block of texels, which spare most points the filter.
class ShadowMap {
public:
    ShadowMap();
    /// Render the model's depth from those beams of the light, given by their numbers, whose layers hold
    /// something else; each box is fitted around the model. Returns how many were rendered.
    int render(const GpuModel& model, const Light& light, const std::vector<std::size_t>& beams);
    /// Whether all those beams' layers are rendered.
    bool holds(const Light& light, const std::vector<std::size_t>& beams) const;
    /// Forget all layers.
    void forget() { layers_.clear(); }
    /// Bind the maps to units 3 and 5 and set what material.glsl needs of these beams and their shadows.
    /// The light itself is given divided by level(), so that light of any strength fits half floats.
    void bind(const gl::Program& program, const Light& light, const std::vector<std::size_t>& beams) const;
    /// The radiance of a white surface that faces all beams and ambient light, per channel; 1 where there is
    /// none.
    static glm::vec3 level(const Light& light);

private:
    struct Layer {
        glm::vec3 direction{0};
        glm::mat4 light_from_world{1};
        float texel_mm = 1;
    };
    void allocate(int size, int layers);
    void find_bounds(int layer);

    gl::Program program_, blocks_program_, bounds_program_;
    gl::Texture depth_, depths_, blocks_, bounds_;
    std::vector<std::optional<Layer>> layers_;
};

} // namespace renderer::passes
