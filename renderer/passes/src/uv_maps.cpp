// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "uv_maps.h"

#include <algorithm>
#include <bit>

#include "lit_frame.h"
#include "shader_library.h"
#include "uv_charts.h"

namespace renderer::passes {
namespace {

// Charts grow by this share of the map's side, so that filters and mipmaps never see beyond them.
constexpr int dilation_share = 64;
// Taps to each side of uv_blur.frag.
constexpr int blur_reach = 3;
// Variance, texels squared, of reading a map halfway between texels, on average over all places.
constexpr float bilinear_variance = 1.0f / 6;
constexpr float widest_step = 0.125f; // of the map's side

/// Floats of 32 bits carry the chart's number along in alpha, which spares reading it.
Defines blur_defines(bool along, bool add = false) {
    const bool carries = light_format() == GL_RGBA32F;
    return {{"REACH", blur_reach},
            {"ALONG_V", along ? 1 : 0},
            {"CHART_IN", carries && along ? 1 : 0},
            {"CHART_OUT", carries && !along ? 1 : 0},
            {"ADD", add ? 1 : 0}};
}

std::vector<float> read_floats(const gl::Texture& texture) {
    std::vector<float> values(static_cast<std::size_t>(texture.width()) *
                              static_cast<std::size_t>(texture.height()));
    glGetTextureImage(texture.id(), 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(values.size() * sizeof(float)),
                      values.data());
    return values;
}

} // namespace

gl::Texture light_map(int size, int levels) {
    gl::Texture texture(light_format(), size, size,
                        std::min(levels, static_cast<int>(std::bit_width(static_cast<unsigned>(size)))));
    texture.filter(levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR, GL_LINEAR);
    gl::Framebuffer({&texture}).clear_color(0, glm::vec4(0));
    return texture;
}

UvWorkspace::UvWorkspace(int size)
    : drawn(light_map(size)), dilated(light_map(size)), half_blurred(light_map(size)),
      wanted(GL_DEPTH_COMPONENT16, size, size), blocks(GL_R8, blocks_along(size), blocks_along(size)) {}

UvTest::UvTest() {
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
}

UvTest::~UvTest() {
    glDepthMask(GL_TRUE);
    glDisable(GL_DEPTH_TEST);
}

UvPasses::UvPasses(std::vector<float> sigmas_mm)
    : sigmas_mm_(std::move(sigmas_mm)), geometry_(load_program("unwrapped.vert", "uv_geometry.frag")),
      select_(load_screen_program("uv_select.frag")), dilate_(load_screen_program("dilate.frag")),
      across_(load_screen_program("uv_blur.frag", blur_defines(false))),
      along_(load_screen_program("uv_blur.frag", blur_defines(true))),
      along_and_add_(load_screen_program("uv_blur.frag", blur_defines(true, true))), ratios_(blur_reach) {
    for (const gl::Program* program : {&across_, &along_, &along_and_add_}) {
        program->set("table_end", ratios_.end);
    }
}

void UvPasses::draw_charts(const scene::Model& source, const GpuModel& model, const UvLayout& layout) const {
    float first_chart = 1; // 0 is no chart
    for (const std::size_t i : layout.meshes) {
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

UvMaps UvPasses::unwrapped(const scene::Model& source, const GpuModel& model, const UvLayout& layout,
                           UvWorkspace& space) const {
    UvMaps maps;
    const int size = space.drawn.width();
    maps.size = size;
    maps.unit_mm = model.extent_mm() / static_cast<float>(size);

    // Rasterise stretch, chart number and number of layers.
    const gl::Texture chart(GL_R32F, size, size);
    const gl::Texture layers(GL_R16F, size, size);
    const gl::Framebuffer target({&space.drawn, &chart, &layers});
    target.bind();
    for (int attachment = 0; attachment < 3; ++attachment) {
        target.clear_color(attachment, glm::vec4(0));
    }
    glEnablei(GL_BLEND, 2);
    glBlendFunci(2, GL_ONE, GL_ONE);
    geometry_.use();
    geometry_.set("unit_mm", maps.unit_mm);
    geometry_.set("uv_origin", layout.uv_origin);
    geometry_.set("uv_scale", layout.uv_scale);
    glDisable(GL_CULL_FACE);
    draw_charts(source, model, layout);
    glDisablei(GL_BLEND, 2);

    const std::vector<float> chart_ids = read_floats(chart);
    const std::vector<float> layer_counts = read_floats(layers);
    const auto covered_count =
        std::count_if(layer_counts.begin(), layer_counts.end(), [](float n) { return n > 0; });
    const auto overlap_count =
        std::count_if(layer_counts.begin(), layer_counts.end(), [](float n) { return n > 1.5f; });
    maps.overlap = static_cast<double>(overlap_count) / static_cast<double>(std::max(covered_count, 1L));

    // Grow the charts: each texel around them stands for the nearest one inside.
    std::vector<bool> covered(chart_ids.size());
    std::transform(chart_ids.begin(), chart_ids.end(), covered.begin(), [](float id) { return id > 0; });
    const std::vector<Texel> nearest = nearest_covered(covered, size, std::max(2, size / dilation_share));
    std::vector<float> grown(chart_ids.size());
    const int blocks = blocks_along(size);
    maps.texels_of_block.resize(static_cast<std::size_t>(blocks) * static_cast<std::size_t>(blocks));
    for (std::size_t i = 0; i < nearest.size(); ++i) {
        if (nearest[i].x >= 0) {
            grown[i] = chart_ids[static_cast<std::size_t>(nearest[i].y) * static_cast<std::size_t>(size) +
                                 static_cast<std::size_t>(nearest[i].x)];
            const int block = nearest[i].y * blocks / size * blocks + nearest[i].x * blocks / size;
            ++maps.texels_of_block[static_cast<std::size_t>(block)];
            ++maps.texels;
        }
    }
    maps.nearest = gl::Texture(GL_RG16I, size, size);
    maps.nearest.upload(GL_RG_INTEGER, GL_SHORT, nearest.data());
    maps.chart = gl::Texture(GL_R32F, size, size);
    maps.chart.upload(GL_RED, GL_FLOAT, grown.data());
    maps.charted = gl::Texture(GL_DEPTH_COMPONENT16, size, size);
    gl::Texture all(GL_R8, 1, 1);
    constexpr std::uint8_t yes = 255;
    all.upload(GL_RED, GL_UNSIGNED_BYTE, &yes);
    draw_selection(maps, all, maps.charted);

    // Blur the stretch map along with what will be blurred: blur k uses the stretch blurred k times.
    for (std::size_t k = 0; k < steps(); ++k) {
        maps.stretch.emplace_back(GL_RG16F, size, size);
    }
    gl::Framebuffer({&space.half_blurred}).clear_color(0, glm::vec4(0));
    dilate(space.drawn, maps.stretch[0], maps, maps.charted);
    for (std::size_t k = 0; k + 1 < maps.stretch.size(); ++k) {
        blur(maps.stretch[k], maps.stretch[k + 1], maps, space, maps.charted, k);
    }
    return maps;
}

void UvPasses::draw_selection(const UvMaps& maps, const gl::Texture& blocks, const gl::Texture& depth) const {
    const gl::Framebuffer target({}, &depth);
    target.bind();
    select_.use();
    maps.nearest.bind(0);
    blocks.bind(1);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    draw_screen();
    glDepthFunc(GL_LESS);
    glDisable(GL_DEPTH_TEST);
}

void UvPasses::want(const UvMaps& maps, const std::vector<std::uint8_t>& blocks, UvWorkspace& space) const {
    space.blocks.upload(GL_RED, GL_UNSIGNED_BYTE, blocks.data());
    draw_selection(maps, space.blocks, space.wanted);
}

void UvPasses::dilate(const gl::Texture& source, const gl::Texture& target, const UvMaps& maps,
                      const gl::Texture& wanted) const {
    const gl::Framebuffer framebuffer({&target}, &wanted);
    framebuffer.bind();
    dilate_.use();
    source.bind(0);
    maps.nearest.bind(1);
    const UvTest test;
    draw_screen();
}

void UvPasses::blur(const gl::Texture& source, const gl::Texture& target, const UvMaps& maps,
                    UvWorkspace& space, const gl::Texture& wanted, std::size_t step,
                    const WeightedSum* sum) const {
    maps.stretch[step].bind(1);
    maps.chart.bind(2);
    ratios_.texture.bind(3);
    nearest_.bind(0);
    nearest_.bind(2);
    const UvTest test;
    const auto pass = [&](const gl::Program& program, const gl::Texture& from,
                          const std::vector<const gl::Texture*>& to) {
        const gl::Framebuffer framebuffer(to, &wanted);
        framebuffer.bind();
        program.use();
        program.set("sigma", sigmas_mm_[step] / maps.unit_mm);
        program.set("gather_variance", step == 0 ? bilinear_variance : 0.0f);
        program.set("widest_px", widest_step * static_cast<float>(maps.size));
        from.bind(0);
        draw_screen();
    };
    pass(across_, source, {&space.half_blurred});
    if (sum) {
        along_and_add_.set("weight_in_sum", sum->weights[step]);
        glEnablei(GL_BLEND, 1);
        glBlendFuncSeparatei(1, GL_ONE, GL_ONE, GL_ONE, GL_ZERO);
        pass(along_and_add_, space.half_blurred, {&target, &sum->map});
        glDisablei(GL_BLEND, 1);
    } else {
        pass(along_, space.half_blurred, {&target});
    }
    gl::Sampler::unbind(0);
    gl::Sampler::unbind(2);
}

} // namespace renderer::passes
