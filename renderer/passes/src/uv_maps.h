// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include <renderer/gl/objects.h>
#include <renderer/scene/model.h>

#include "gpu_model.h"
#include "screen_blur.h"
#include "uv_layout.h"

namespace renderer::passes {

/// What depends on a layout alone, for maps of one size.
struct UvMaps {
    int size = 0;
    float unit_mm = 1;                ///< of the stretch maps: a texel's side, were the model one flat map
    gl::Texture nearest;              ///< RG16I: the texel on a chart that a texel stands for, or -1
    gl::Texture chart;                ///< R32F: its number, 0 for none
    gl::Texture charted;              ///< a depth buffer: 1 on charts, else 0
    std::vector<gl::Texture> stretch; ///< RG16F: texels per unit along u and v; [k]: blurred k times
    std::vector<int> texels_of_block; ///< how many texels stand for one in the block
    int texels = 0;                   ///< on charts
    double overlap = 0;               ///< share of texels that several triangles cover
};

/// What all work on maps of one size needs.
struct UvWorkspace {
    explicit UvWorkspace(int size);
    gl::Texture drawn, dilated, half_blurred;
    gl::Texture wanted; ///< a depth buffer: 1 where texels are wanted, else 0
    gl::Texture blocks; ///< R8: which blocks are wanted
};

/// Where to add up the Gaussians, and the weight of each.
struct WeightedSum {
    const gl::Texture& map;
    const std::vector<glm::vec3>& weights;
};

/// While it lives, drawing into a target with one of the depth buffers above leaves texels with 0 alone.
class UvTest {
public:
    UvTest();
    ~UvTest();
    UvTest(const UvTest&) = delete;
    UvTest& operator=(const UvTest&) = delete;
};

/// The passes over maps: unwrapping, dilation, and blurs along the surface, each Gaussian after another.
class UvPasses {
public:
    explicit UvPasses(std::vector<float> sigmas_mm);

    UvMaps unwrapped(const scene::Model& source, const GpuModel& model, const UvLayout& layout,
                     UvWorkspace& space) const;
    /// Make `space.wanted` hold the texels that stand for one in a wanted block.
    void want(const UvMaps& maps, const std::vector<std::uint8_t>& blocks, UvWorkspace& space) const;
    /// Give each wanted texel the value of the texel on a chart that it stands for, and an alpha of 1.
    void dilate(const gl::Texture& source, const gl::Texture& target, const UvMaps& maps,
                const gl::Texture& wanted) const;
    /// Blur the wanted texels by Gaussian `step`. What is not wanted has the alpha 0 in the source, and in
    /// `space.half_blurred` before the first step. The target may be the source.
    void blur(const gl::Texture& source, const gl::Texture& target, const UvMaps& maps, UvWorkspace& space,
              const gl::Texture& wanted, std::size_t step, const WeightedSum* sum = nullptr) const;
    std::size_t steps() const { return sigmas_mm_.size(); }

private:
    void draw_charts(const scene::Model& source, const GpuModel& model, const UvLayout& layout) const;
    void draw_selection(const UvMaps& maps, const gl::Texture& blocks, const gl::Texture& depth) const;

    std::vector<float> sigmas_mm_;
    gl::Program geometry_, select_, dilate_, across_, along_, along_and_add_;
    RatioTable ratios_;
    gl::Sampler nearest_{GL_NEAREST, GL_CLAMP_TO_BORDER}; ///< with no chart beyond the edge
};

/// A map of light, cleared.
gl::Texture light_map(int size, int levels = 1);

} // namespace renderer::passes
