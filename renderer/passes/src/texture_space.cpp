// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "texture_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <support/error.h>

#include "shader_library.h"

namespace renderer::passes {
namespace {

// Coarser mipmap levels than this would mix charts that the dilation keeps apart.
constexpr int gather_levels = 4;
// A share of doubly covered texels above this is more than the edges of triangles can make.
constexpr double tolerated_overlap = 0.002;
// The culled form lights what lies within so many standard deviations of the widest Gaussian around what is
// seen.
constexpr float margin_sigmas = 3;
// Its maps have so many texels along a pixel, on average; where charts are stretched, fewer.
constexpr float texels_a_pixel = 2;
// They shrink to this share of the full side at most, and not below so many texels.
constexpr int smallest_share = 8;
constexpr int smallest_side = 16;

/// The Gaussians that the maps hold: all but the narrowest, unless it is the only one.
optics::Profile blurred_in_maps(const optics::Profile& profile) {
    optics::Profile blurred = profile;
    if (blurred.gaussians.size() > 1) {
        blurred.gaussians.erase(blurred.gaussians.begin());
    }
    return blurred;
}

std::vector<glm::vec3> weights_of(const optics::Profile& profile) {
    std::vector<glm::vec3> weights;
    for (const optics::Gaussian& g : profile.gaussians) {
        weights.emplace_back(g.weight);
    }
    return weights;
}

std::vector<float> cascade_of(const optics::Profile& profile) {
    std::vector<float> sigmas_mm;
    for (const double sigma : optics::cascade_sigmas_mm(profile)) {
        sigmas_mm.push_back(static_cast<float>(sigma));
    }
    return sigmas_mm;
}

} // namespace

TextureSpace::TextureSpace(const scene::Model& source, const GpuModel& model, const optics::Profile& profile,
                           const Methods& methods, int width, int height, int samples)
    : source_(source), size_(methods.ts.map_size), samples_(samples), culled_(methods.ts.culled),
      margin_mm_(margin_sigmas * static_cast<float>(std::sqrt(profile.gaussians.back().variance_mm2))),
      weights_(weights_of(blurred_in_maps(profile))), passes_(cascade_of(blurred_in_maps(profile))),
      irradiance_("unwrapped.vert", "irradiance.frag"), gather_(load_program("surface.vert", "gather.frag")),
      resolve_(load_screen_program("resolve_color.frag")),
      add_narrowest_(load_screen_program("add_narrowest.frag")),
      gathered_samples_(light_format(), width, height, 1, samples),
      depth_(GL_DEPTH_COMPONENT32F, width, height, 1, samples), gathered_(light_format(), width, height),
      scattered_(light_format(), width, height), gather_target_({&gathered_samples_}, &depth_),
      gathered_target_({&gathered_}), scattered_target_({&scattered_}) {
    gl::Framebuffer({&nowhere_}).clear_color(0, glm::vec4(0));
    gathered_target_.clear_color(0, glm::vec4(0)); // only the skin's rectangle is drawn
    scattered_target_.clear_color(0, glm::vec4(0));
    if (profile.gaussians.size() > 1) {
        narrowest_weight_ = profile.gaussians.front().weight;
    }
    for (const scene::Mesh& mesh : source.meshes) {
        if (!mesh.has_uv && source.materials[mesh.material].scatters) {
            throw support::input_error(
                "{}: expected texture coordinates (TEXCOORD_0) for the shader ts, found a mesh "
                "without",
                source.name);
        }
    }
    for (std::size_t material = 0; material < source.materials.size(); ++material) {
        const bool used = std::any_of(source.meshes.begin(), source.meshes.end(),
                                      [&](const scene::Mesh& mesh) { return mesh.material == material; });
        if (used && source.materials[material].scatters) {
            add_skin(model, material);
        }
    }
}

void TextureSpace::add_skin(const GpuModel& model, std::size_t material) {
    Skin added;
    added.material = material;
    added.layout = uv_layout(source_, material);
    const auto alike = std::find_if(skins_.begin(), skins_.end(), [&](const Skin& skin) {
        return lie_alike(source_, skin.layout, added.layout);
    });
    added.alike = static_cast<std::size_t>(alike - skins_.begin());
    skins_.push_back(std::move(added));
    const UvMaps& unwrapped = maps(model, skins_.back(), size_);
    if (unwrapped.texels == 0) {
        throw support::input_error(
            "{}: expected texture coordinates that cover an area for the shader ts, found none",
            source_.name);
    }
    if (unwrapped.overlap > tolerated_overlap) {
        warnings_.push_back(
            fmt::format("{}: the texture coordinates of material {} overlap on {:.1f} % of their area; "
                        "ts mixes the light of what overlaps",
                        source_.name, material, 100 * unwrapped.overlap));
    }
}

const UvMaps& TextureSpace::maps(const GpuModel& model, const Skin& skin, int size) {
    Skin& first = skins_[skin.alike];
    const auto found = first.maps.find(size);
    if (found != first.maps.end()) {
        return found->second;
    }
    UvWorkspace& space = spaces_.try_emplace(size, size).first->second;
    return first.maps.emplace(size, passes_.unwrapped(source_, model, first.layout, space)).first->second;
}

gl::Texture& TextureSpace::scattered(Skin& skin, int size) const {
    // The coarsest level of all sizes is the same, so that they look alike.
    int levels = gather_levels;
    for (int larger = size_; larger / 2 >= size && levels > 1; larger /= 2) {
        --levels;
    }
    const auto found = skin.scattered.find(size);
    return found != skin.scattered.end()
               ? found->second
               : skin.scattered.emplace(size, light_map(size, levels)).first->second;
}

/// The side of the coarsest map that has texels_a_pixel texels to a pixel where the skin is nearest: the size
/// by depth of [JimenezGutierrez2008]. 0 where no part of the skin is in view.
int TextureSpace::fitting_size(const Skin& skin, const GpuModel& model, const GpuModel::View& view,
                               const scene::Camera& camera) const {
    float nearest_mm = std::numeric_limits<float>::infinity();
    for (const GpuModel::Part& part : view.parts) {
        if (model.meshes()[part.mesh].material == skin.material) {
            nearest_mm = std::min(nearest_mm, part.nearest_mm);
        }
    }
    if (std::isinf(nearest_mm)) {
        return 0;
    }
    const float wanted =
        texels_a_pixel * skin.layout.side_mm * camera.focal_px() / std::max(nearest_mm, 1e-6f);
    const int least = std::max(size_ / smallest_share, std::min(size_, smallest_side));
    int size = size_;
    while (size / 2 >= least && static_cast<float>(size / 2) >= wanted) {
        size /= 2;
    }
    return size;
}

const gl::Texture* TextureSpace::wanted(const Skin& skin, const UvMaps& maps, const GpuModel::View& view,
                                        const scene::Camera& camera) {
    const std::vector<std::uint8_t> blocks =
        wanted_blocks(source_, view, camera, skin.layout, maps.size, margin_mm_);
    long long texels = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        texels += blocks[i] != 0 ? maps.texels_of_block[i] : 0;
    }
    if (texels == 0) {
        return nullptr;
    }
    counts_.texels_lit += texels;
    counts_.texels_skipped += maps.texels - texels;
    UvWorkspace& space = spaces_.at(maps.size);
    passes_.want(maps, blocks, space);
    return &space.wanted;
}

void TextureSpace::light(const GpuModel& model, const GpuModel::View& view, const scene::Camera& camera,
                         const SurfaceLook& look, const Light& light, const std::vector<std::size_t>& beams,
                         const ShadowMap& shadow, const Switches& switches) {
    counts_ = {};
    for (Skin& skin : skins_) {
        counts_.layouts += &skin == &skins_[skin.alike] ? 1 : 0;
        // Choose what to light.
        skin.size = culled_ ? fitting_size(skin, model, view, camera) : size_;
        const UvMaps* its_maps = skin.size > 0 ? &maps(model, skin, skin.size) : nullptr;
        const gl::Texture* texels = nullptr;
        if (its_maps && culled_) {
            texels = wanted(skin, *its_maps, view, camera);
        } else if (its_maps) {
            texels = &its_maps->charted;
            counts_.texels_lit += its_maps->texels;
        }
        if (!texels) {
            skin.size = 0;
            ++counts_.maps_skipped;
            continue;
        }
        ++counts_.maps_lit;
        counts_.sizes.insert(skin.size);

        const gl::Program& irradiance =
            irradiance_.with(look.defines(model.traits(skin.material), beams.size(), switches));
        irradiance.use();
        look.bind(irradiance);
        shadow.bind(irradiance, light, beams);
        draw_irradiance(irradiance, model, skin, spaces_.at(skin.size).drawn, *texels);
        blur(skin, *its_maps, *texels);
    }
}

void TextureSpace::draw_irradiance(const gl::Program& irradiance, const GpuModel& model, const Skin& skin,
                                   const gl::Texture& map, const gl::Texture& wanted) const {
    const gl::Framebuffer target({&map}, &wanted);
    target.bind();
    target.clear_color(0, glm::vec4(0));
    irradiance.set("uv_origin", skin.layout.uv_origin);
    irradiance.set("uv_scale", skin.layout.uv_scale);
    // In the unwrapped mesh a triangle's winding says nothing about its side.
    model.bind_material(irradiance, skin.material, false);
    const UvTest test;
    for (const std::size_t mesh : skin.layout.meshes) {
        GpuModel::draw_mesh(model.meshes()[mesh]);
    }
}

void TextureSpace::blur(Skin& skin, const UvMaps& maps, const gl::Texture& wanted) {
    // What is not wanted keeps the alpha 0: it takes no part in blurs, nor when the maps are read.
    UvWorkspace& space = spaces_.at(maps.size);
    gl::Texture& sum = scattered(skin, maps.size);
    gl::Framebuffer({&space.dilated}).clear_color(0, glm::vec4(0));
    gl::Framebuffer({&space.half_blurred}).clear_color(0, glm::vec4(0));
    gl::Framebuffer({&sum}).clear_color(0, glm::vec4(0));
    passes_.dilate(space.drawn, space.dilated, maps, wanted);
    const WeightedSum into{sum, weights_};
    for (std::size_t k = 0; k < passes_.steps(); ++k) {
        passes_.blur(space.dilated, space.dilated, maps, space, wanted, k, &into);
    }
    sum.generate_mipmaps();
}

void TextureSpace::draw_gathered(const GpuModel& model, const GpuModel::View& view) const {
    const ReversedDepth depth;
    for (const GpuModel::Part& part : view.parts) {
        const std::size_t material = model.meshes()[part.mesh].material;
        model.bind_material(gather_, material, true); // for its culling
        const auto skin = std::find_if(skins_.begin(), skins_.end(), [&](const Skin& candidate) {
            return candidate.material == material && candidate.size > 0;
        });
        // What is not skin has no light here, but it may stand before some.
        gather_.set("is_skin", model.traits(material).scatters ? 1 : 0);
        if (skin != skins_.end()) {
            skin->scattered.at(skin->size).bind(0);
            gather_.set("uv_origin", skin->layout.uv_origin);
            gather_.set("uv_scale", skin->layout.uv_scale);
        } else { // skin that has no place in a map keeps its light
            nowhere_.bind(0);
        }
        model.draw_part(part);
    }
    glDisable(GL_CULL_FACE);
}

const gl::Texture& TextureSpace::gather(const GpuModel& model, const GpuModel::View& view,
                                        const LitFrame& lit, const gl::Texture& narrowest,
                                        const scene::Camera& camera) {
    // Look up the light at each sample of the visible surface.
    begin_rect(gather_target_, lit.rect);
    gather_target_.clear_color(0, glm::vec4(0));
    gather_target_.clear_depth(0);
    gather_.use();
    set_camera(gather_, camera, model.bounds());
    gather_.set("weight_in_maps", std::accumulate(weights_.begin(), weights_.end(), glm::vec3(0)));
    lit.diffuse.bind(6);
    draw_gathered(model, view);
    end_rect();
    const gl::Texture* gathered = &gathered_samples_;
    if (samples_ > 1) {
        begin_rect(gathered_target_, lit.skin);
        resolve_.use();
        resolve_.set("samples", samples_);
        gathered_samples_.bind(0);
        draw_screen();
        end_rect();
        gathered = &gathered_;
    }

    begin_rect(scattered_target_, lit.skin);
    add_narrowest_.use();
    add_narrowest_.set("narrowest_weight", narrowest_weight_);
    narrowest.bind(0);
    gathered->bind(1);
    draw_screen();
    end_rect();
    return scattered_;
}

} // namespace renderer::passes
