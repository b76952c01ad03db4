// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "texture_space.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <support/error.h>

#include "screen_blur.h"
#include "shader_library.h"
#include "uv_charts.h"

namespace renderer::passes {
namespace {

std::vector<glm::vec3> profile_weights(const optics::Profile& profile) {
    std::vector<glm::vec3> weights;
    for (const optics::Gaussian& g : profile.gaussians) {
        weights.emplace_back(g.weight);
    }
    return weights;
}

// Charts grow by this share of the map's side, so that filters and mipmaps never see beyond them.
constexpr int dilation_share = 64;
// Coarser mipmap levels than this would mix charts that the dilation keeps apart.
constexpr int gather_levels = 4;
// Taps to each side of uv_blur.frag.
constexpr int blur_reach = 3;
// Variance, texels squared, of reading a map halfway between texels, on average over all places.
constexpr float bilinear_variance = 1.0f / 6;
// A share of doubly covered texels above this is more than the edges of triangles can make.
constexpr double tolerated_overlap = 0.002;

gl::Texture map_texture(GLenum format, int size, int levels = 1) {
    gl::Texture texture(format, size, size,
                        std::min(levels, static_cast<int>(std::bit_width(static_cast<unsigned>(size)))));
    texture.filter(levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR, GL_LINEAR);
    return texture;
}

} // namespace

TextureSpace::TextureSpace(const scene::Model& source, const GpuModel& model, const optics::Profile& profile,
                           const Methods& methods, int width, int height, int samples)
    : size_(methods.ts.map_size), samples_(samples), unit_mm_(model.extent_mm() / static_cast<float>(size_)),
      weights_(profile_weights(profile)), irradiance_("unwrapped.vert", "irradiance.frag"),
      geometry_(load_program("unwrapped.vert", "uv_geometry.frag")),
      dilate_(load_screen_program("dilate.frag")), blur_(load_screen_program("uv_blur.frag")),
      gather_(load_program("surface.vert", "gather.frag")),
      resolve_(load_screen_program("resolve_color.frag")),
      add_narrowest_(load_screen_program("add_narrowest.frag")), ratios_(blur_reach),
      nearest_(GL_NEAREST, GL_CLAMP_TO_BORDER), raw_(map_texture(light_format(), size_)),
      half_blurred_(map_texture(light_format(), size_)), irradiance_map_(map_texture(light_format(), size_)),
      gathered_samples_(light_format(), width, height, 1, samples),
      depth_(GL_DEPTH_COMPONENT32F, width, height, 1, samples), gathered_(light_format(), width, height),
      scattered_(light_format(), width, height), gather_target_({&gathered_samples_}, &depth_),
      gathered_target_({&gathered_}), scattered_target_({&scattered_}) {
    gathered_target_.clear_color(0, glm::vec4(0)); // only the skin's rectangle is drawn
    scattered_target_.clear_color(0, glm::vec4(0));

    // The cascade starts at the second Gaussian.
    std::vector<optics::Gaussian> blurred = profile.gaussians;
    narrowest_weight_ = weights_.front();
    if (blurred.size() > 1) {
        weights_.erase(weights_.begin());
        blurred.erase(blurred.begin());
    } else {
        narrowest_weight_ = glm::vec3(0); // a single Gaussian is blurred in the map
    }
    for (const double sigma : optics::cascade_sigmas_mm({profile.name, blurred})) {
        sigmas_mm_.push_back(static_cast<float>(sigma));
    }
    blur_.set("table_end", ratios_.end);
    blur_.set("widest_px", 0.125f * static_cast<float>(size_));

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
            maps_.push_back(unwrapped(source, model, material));
        }
    }
}

void TextureSpace::draw_charts(const scene::Model& source, const GpuModel& model, const Map& map) const {
    float first_chart = 1; // 0 is no chart
    for (std::size_t i = 0; i < source.meshes.size(); ++i) {
        if (source.meshes[i].material != map.material) {
            continue;
        }
        // Sort the triangles by chart and draw them chart by chart.
        const std::vector<std::uint32_t>& indices = source.meshes[i].indices;
        const std::vector<std::uint32_t> charts = chart_of_triangle(source.meshes[i]);
        const std::uint32_t count = charts.empty() ? 0 : *std::max_element(charts.begin(), charts.end()) + 1;
        std::vector<std::vector<std::uint32_t>> by_chart(count);
        for (std::size_t t = 0; t < charts.size(); ++t) {
            const auto corner = indices.begin() + static_cast<std::ptrdiff_t>(3 * t);
            by_chart[charts[t]].insert(by_chart[charts[t]].end(), corner, corner + 3);
        }
        glBindVertexArray(model.meshes()[i].array.id());
        for (std::uint32_t chart = 0; chart < count; ++chart) {
            const gl::Buffer buffer(by_chart[chart].data(), by_chart[chart].size() * sizeof(std::uint32_t));
            glVertexArrayElementBuffer(model.meshes()[i].array.id(), buffer.id());
            geometry_.set("chart", first_chart + static_cast<float>(chart));
            glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(by_chart[chart].size()), GL_UNSIGNED_INT,
                           nullptr);
        }
        glVertexArrayElementBuffer(model.meshes()[i].array.id(), model.meshes()[i].indices.id());
        first_chart += static_cast<float>(count);
    }
}

TextureSpace::Map TextureSpace::unwrapped(const scene::Model& source, const GpuModel& model,
                                          std::size_t material) {
    // Fit coordinates that leave the unit square into the map; others are used as they are.
    Map map;
    map.material = material;
    glm::vec2 low(0);
    glm::vec2 high(1);
    for (const scene::Mesh& mesh : source.meshes) {
        for (const scene::Vertex& vertex : mesh.vertices) {
            if (mesh.material == material) {
                low = glm::min(low, vertex.uv);
                high = glm::max(high, vertex.uv);
            }
        }
    }
    map.uv_origin = low;
    map.uv_scale = 1.0f / (high - low);

    // Rasterise stretch, chart number and number of layers.
    const gl::Texture chart(GL_R32F, size_, size_);
    const gl::Texture layers(GL_R16F, size_, size_);
    const gl::Framebuffer target({&raw_, &chart, &layers});
    target.bind();
    for (int attachment = 0; attachment < 3; ++attachment) {
        target.clear_color(attachment, glm::vec4(0));
    }
    glEnablei(GL_BLEND, 2);
    glBlendFunci(2, GL_ONE, GL_ONE);
    geometry_.use();
    geometry_.set("unit_mm", unit_mm_);
    geometry_.set("uv_origin", map.uv_origin);
    geometry_.set("uv_scale", map.uv_scale);
    glDisable(GL_CULL_FACE);
    draw_charts(source, model, map);
    glDisablei(GL_BLEND, 2);

    const std::size_t texels = static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_);
    std::vector<float> chart_ids(texels);
    std::vector<float> layer_counts(texels);
    const auto bytes = static_cast<GLsizei>(texels * sizeof(float));
    glGetTextureImage(chart.id(), 0, GL_RED, GL_FLOAT, bytes, chart_ids.data());
    glGetTextureImage(layers.id(), 0, GL_RED, GL_FLOAT, bytes, layer_counts.data());
    const auto covered_count = static_cast<double>(
        std::count_if(layer_counts.begin(), layer_counts.end(), [](float n) { return n > 0; }));
    const auto overlap_count = static_cast<double>(
        std::count_if(layer_counts.begin(), layer_counts.end(), [](float n) { return n > 1.5f; }));
    if (covered_count == 0) {
        throw support::input_error(
            "{}: expected texture coordinates that cover an area for the shader ts, found none", source.name);
    }
    if (overlap_count > tolerated_overlap * covered_count) {
        warnings_.push_back(
            fmt::format("{}: the texture coordinates of material {} overlap on {:.1f} % of their area; "
                        "ts mixes the light of what overlaps",
                        source.name, material, 100 * overlap_count / covered_count));
    }

    // Grow the charts: each texel around them stands for the nearest one inside.
    std::vector<bool> covered(texels);
    std::transform(chart_ids.begin(), chart_ids.end(), covered.begin(), [](float id) { return id > 0; });
    const std::vector<Texel> nearest = nearest_covered(covered, size_, std::max(2, size_ / dilation_share));
    std::vector<float> grown(texels);
    for (std::size_t i = 0; i < texels; ++i) {
        if (nearest[i].x >= 0) {
            grown[i] = chart_ids[static_cast<std::size_t>(nearest[i].y) * static_cast<std::size_t>(size_) +
                                 static_cast<std::size_t>(nearest[i].x)];
        }
    }
    map.nearest = gl::Texture(GL_RG16I, size_, size_);
    map.nearest.upload(GL_RG_INTEGER, GL_SHORT, nearest.data());
    map.chart = gl::Texture(GL_R32F, size_, size_);
    map.chart.upload(GL_RED, GL_FLOAT, grown.data());

    // Blur the stretch map along with what will be blurred: blur k uses the stretch blurred k times.
    for (std::size_t k = 0; k < sigmas_mm_.size(); ++k) {
        map.stretch.push_back(map_texture(GL_RGBA16F, size_));
        map.gaussians.push_back(map_texture(light_format(), size_, gather_levels));
    }
    const gl::Framebuffer first({&map.stretch[0]});
    first.bind();
    dilate_.use();
    raw_.bind(0);
    map.nearest.bind(1);
    draw_screen();
    for (std::size_t k = 0; k + 1 < map.stretch.size(); ++k) {
        blur(map.stretch[k], map.stretch[k + 1], map, k);
    }
    return map;
}

void TextureSpace::blur(const gl::Texture& source, const gl::Texture& target, const Map& map,
                        std::size_t step) {
    blur_.use();
    blur_.set("sigma", sigmas_mm_[step] / unit_mm_);
    blur_.set("gather_variance", step == 0 ? bilinear_variance : 0.0f);
    ratios_.texture.bind(3);
    nearest_.bind(0);
    nearest_.bind(2);
    map.stretch[step].bind(1);
    map.chart.bind(2);
    const gl::Framebuffer horizontal({&half_blurred_});
    horizontal.bind();
    source.bind(0);
    blur_.set("axis", glm::ivec2(1, 0));
    draw_screen();
    const gl::Framebuffer vertical({&target});
    vertical.bind();
    half_blurred_.bind(0);
    blur_.set("axis", glm::ivec2(0, 1));
    draw_screen();
    gl::Sampler::unbind(0);
    gl::Sampler::unbind(2);
}

void TextureSpace::light(const GpuModel& model, const SurfaceLook& look, const Light& light,
                         const std::vector<std::size_t>& beams, const ShadowMap& shadow,
                         const Switches& switches) {
    for (Map& map : maps_) {
        const gl::Framebuffer target({&raw_});
        target.bind();
        target.clear_color(0, glm::vec4(0));
        const gl::Program& irradiance =
            irradiance_.with(look.defines(model.traits(map.material), beams.size(), switches));
        irradiance.use();
        irradiance.set("uv_origin", map.uv_origin);
        irradiance.set("uv_scale", map.uv_scale);
        look.bind(irradiance);
        shadow.bind(irradiance, light, beams);
        // In the unwrapped mesh a triangle's winding says nothing about its side.
        model.bind_material(irradiance, map.material, false);
        for (const GpuModel::Mesh& mesh : model.meshes()) {
            if (mesh.material == map.material) {
                GpuModel::draw_mesh(mesh);
            }
        }
        const gl::Framebuffer dilated({&irradiance_map_});
        dilated.bind();
        dilate_.use();
        raw_.bind(0);
        map.nearest.bind(1);
        draw_screen();

        const gl::Texture* source = &irradiance_map_;
        for (std::size_t k = 0; k < map.gaussians.size(); ++k) {
            blur(*source, map.gaussians[k], map, k);
            source = &map.gaussians[k];
        }
        for (gl::Texture& gaussian : map.gaussians) {
            gaussian.generate_mipmaps();
        }
    }
}

void TextureSpace::draw_gathered(const GpuModel& model, const GpuModel::View& view) const {
    const ReversedDepth depth;
    for (const GpuModel::Part& part : view.parts) {
        const std::size_t material = model.meshes()[part.mesh].material;
        model.bind_material(gather_, material, true); // for its culling
        const auto found = std::find_if(maps_.begin(), maps_.end(),
                                        [&](const Map& map) { return map.material == material; });
        if (found == maps_.end()) { // not skin, but it may stand before some
            gather_.set("count", 0);
            model.draw_part(part);
            continue;
        }
        const Map& map = *found;
        gather_.set("count", static_cast<int>(weights_.size()));
        for (std::size_t k = 0; k < map.gaussians.size(); ++k) {
            map.gaussians[k].bind(static_cast<GLuint>(k));
        }
        gather_.set("uv_origin", map.uv_origin);
        gather_.set("uv_scale", map.uv_scale);
        model.draw_part(part);
    }
    glDisable(GL_CULL_FACE);
}

const gl::Texture& TextureSpace::gather(const GpuModel& model, const GpuModel::View& view,
                                        const LitFrame& lit, const gl::Texture& narrowest,
                                        const scene::Camera& camera) {
    // Sum the Gaussians at each sample of the visible surface.
    begin_rect(gather_target_, lit.rect);
    gather_target_.clear_color(0, glm::vec4(0));
    gather_target_.clear_depth(0);
    gather_.use();
    set_camera(gather_, camera, model.bounds());
    gather_.set("weights", weights_);
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
