// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <renderer/scene/image_file.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <support/error.h>
#include <support/file.h>

namespace renderer::scene {
namespace {

constexpr int largest_side = 16384;

/// A file name whose extension leads OpenImageIO to the format that the first bytes show.
std::string format_hint(std::span<const std::uint8_t> bytes) {
    const auto starts_with = [&](std::initializer_list<std::uint8_t> magic) {
        return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
    };
    if (starts_with({0x89, 'P', 'N', 'G'})) {
        return "memory.png";
    }
    if (starts_with({0xff, 0xd8, 0xff})) {
        return "memory.jpg";
    }
    if (starts_with({'R', 'I', 'F', 'F'})) {
        return "memory.webp";
    }
    return {};
}

/// Repeat grey into RGB and drop channels after the fourth.
Image with_colour_channels(const std::vector<std::uint8_t>& pixels, int width, int height, int channels) {
    const bool grey = channels < 3;
    Image image{width, height, channels == 2 || channels >= 4 ? 4 : 3, {}};
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    image.pixels.reserve(count * static_cast<std::size_t>(image.channels));
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* p = &pixels[i * static_cast<std::size_t>(channels)];
        image.pixels.insert(image.pixels.end(), {p[0], p[grey ? 0 : 1], p[grey ? 0 : 2]});
        if (image.channels == 4) {
            image.pixels.push_back(p[grey ? 1 : 3]);
        }
    }
    return image;
}

} // namespace

ImagePtr decode_image(std::span<const std::uint8_t> bytes, const std::string& name) {
    const std::string hint = format_hint(bytes);
    if (hint.empty()) {
        throw support::input_error("{}: expected a PNG, JPEG or WebP image, found {} bytes of something else",
                                   name, bytes.size());
    }
    OIIO::Filesystem::IOMemReader memory(const_cast<std::uint8_t*>(bytes.data()), bytes.size());
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1;
    void* proxy = &memory;
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR,
                     &proxy); // the argument for it is lost beside a configuration
    const auto input = OIIO::ImageInput::open(hint, &config);
    if (!input) {
        throw support::input_error("{}: expected an image, found: {}", name, OIIO::geterror());
    }
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.width > largest_side || spec.height > largest_side ||
        spec.nchannels < 1) {
        throw support::input_error(
            "{}: expected an image of 1 to {} pixels a side, found {}x{} with {} channels", name,
            largest_side, spec.width, spec.height, spec.nchannels);
    }
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(spec.width) *
                                     static_cast<std::size_t>(spec.height) * channels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, pixels.data())) {
        throw support::input_error("{}: expected a whole image, found: {}", name, input->geterror());
    }
    if (spec.nchannels == 3 || spec.nchannels == 4) {
        return std::make_shared<const Image>(
            Image{spec.width, spec.height, spec.nchannels, std::move(pixels)});
    }
    return std::make_shared<const Image>(
        with_colour_channels(pixels, spec.width, spec.height, spec.nchannels));
}

ImagePtr read_image(const std::filesystem::path& file) {
    return decode_image(support::read_bytes(file, std::uintmax_t{1} << 30), file.string());
}

} // namespace renderer::scene
