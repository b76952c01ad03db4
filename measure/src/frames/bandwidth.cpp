// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "bandwidth.h"

#include <epoxy/gl.h>

#include <renderer/gl/objects.h>

#include "stopwatch.h"

namespace measure {
namespace {

// Two maps of RGBA32F: each pixel's kernel and plane; depth as R32F and in the depth buffer.
constexpr double surface_bytes = 32, depth_bytes = 4;

} // namespace

int blur_texel_bytes(int target_bits, bool on_cpu) {
    return (target_bits == 0 ? (on_cpu ? 32 : 16) : target_bits) / 2;
}

double blur_bytes(const std::map<std::string, long long>& counts, long long skin_pixels, int texel_bytes) {
    const auto count = [&](const char* name) {
        const auto found = counts.find(name);
        return found == counts.end() ? 0.0 : static_cast<double>(found->second);
    };
    const double light = texel_bytes;
    const double at_half = count("gaussians at half resolution");
    const double at_full = count("gaussians") + count("gaussians in part") - at_half;
    // The surface: the depth in, both maps and the depth buffer out.
    const double find = depth_bytes + surface_bytes + depth_bytes;
    // Both passes read light and surface and write light; the second reads and writes the sum, too.
    const double gaussian = 2 * (light + surface_bytes + light) + 2 * light;
    double bytes = find + at_full * gaussian;
    if (at_half > 0) {
        const double halve = (light + depth_bytes) * (1 + 0.25);
        const double enlarge = 0.25 * (light + depth_bytes) + depth_bytes + 2 * light;
        bytes += halve + 0.25 * (find + at_half * gaussian) + enlarge;
    }
    return bytes * static_cast<double>(skin_pixels);
}

double copy_bytes_per_ms(int texel_bytes, int width, int height) {
    const GLenum format = texel_bytes == 16 ? GL_RGBA32F : texel_bytes == 8 ? GL_RGBA16F : GL_SRGB8_ALPHA8;
    const renderer::gl::Texture from(format, width, height), to(format, width, height);
    const auto copy = [&] {
        glCopyImageSubData(from.id(), GL_TEXTURE_2D, 0, 0, 0, 0, to.id(), GL_TEXTURE_2D, 0, 0, 0, 0, width,
                           height, 1);
    };
    copy(); // new memory is met for the first time
    constexpr int copies = 8;
    const double time_ms = gl_time_ms([&] {
        for (int i = 0; i < copies; ++i) {
            copy();
        }
    });
    return 2.0 * texel_bytes * width * height * copies / time_ms;
}

} // namespace measure
