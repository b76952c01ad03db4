// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "picture_store.h"

#include <algorithm>

#include <OpenImageIO/imageio.h>

#include <support/error.h>

namespace experiment {
namespace {

constexpr GLuint window_framebuffer = 0;

void clear(double level) {
    const auto grey = static_cast<float>(level);
    const std::array color{grey, grey, grey, 1.0F};
    glClearNamedFramebufferfv(window_framebuffer, GL_COLOR, 0, color.data());
}

} // namespace

GpuPicture::GpuPicture(const Pixels& pixels)
    : texture_(GL_RGBA8, pixels.width, pixels.height), framebuffer_({&texture_}) {
    texture_.upload(GL_RGBA, GL_UNSIGNED_BYTE, pixels.rgba.data());
}

void GpuPicture::draw(const std::array<int, 2>& framebuffer_size) const {
    const int width = texture_.width();
    const int height = texture_.height();
    const int left = (framebuffer_size[0] - width) / 2;
    const int bottom = (framebuffer_size[1] - height) / 2;
    // The picture's first row is its top, the window's is its bottom.
    glBlitNamedFramebuffer(framebuffer_.id(), window_framebuffer, 0, 0, width, height, left, bottom + height,
                           left + width, bottom, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

Pixels PictureStore::decode(const fs::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input) {
        throw support::input_error("{}: expected a PNG picture, found: {}", file.string(), OIIO::geterror());
    }
    const OIIO::ImageSpec& spec = input->spec();
    Pixels pixels{spec.width, spec.height, {}};
    const auto count = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
    pixels.rgba.assign(4 * count, 255);
    const int channels = std::min(spec.nchannels, 4);
    if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, pixels.rgba.data(), 4)) {
        throw support::input_error("{}: expected a whole PNG picture, found: {}", file.string(),
                                   input->geterror());
    }
    return pixels;
}

void PictureStore::draw(const Picture& picture, const std::array<int, 2>& framebuffer_size) const {
    glViewport(0, 0, framebuffer_size[0], framebuffer_size[1]);
    if (const auto* page = std::get_if<Page>(&picture)) {
        draw_page(page->text, framebuffer_size);
    } else if (const auto* grey = std::get_if<Grey>(&picture)) {
        draw_grey(grey->level);
    } else {
        clear(0); // black around the picture, where the screen is larger
        stimuli_.at(std::get<Stimulus>(picture)).draw(framebuffer_size);
    }
    glFinish();
}

void draw_grey(double level) { clear(level); }

void draw_page(const std::string& text, const std::array<int, 2>& framebuffer_size) {
    clear(page_ground);
    GpuPicture(render_page(text, framebuffer_size[0], framebuffer_size[1])).draw(framebuffer_size);
}

} // namespace experiment
