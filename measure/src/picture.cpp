// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <measure/picture.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <boost/crc.hpp>

#include <renderer/optics/color.h>
#include <support/error.h>
#include <support/file.h>

namespace measure {
namespace {

// Bounds that keep a comparison inside a test machine's memory.
constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 30;
constexpr std::int64_t most_pixels = std::int64_t{1} << 26;

enum class Format { png, exr };

std::optional<Format> format_of(std::span<const std::uint8_t> bytes) {
    const auto starts_with = [&](std::initializer_list<std::uint8_t> magic) {
        return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
    };
    if (starts_with({0x89, 'P', 'N', 'G'})) {
        return Format::png;
    }
    return starts_with({0x76, 0x2f, 0x31, 0x01}) ? std::optional(Format::exr) : std::nullopt;
}

/// Refuse a PNG that is cut off or damaged, of which the decoder would complain in a line of its own
/// [PNG2003, Sec. 5.3].
void check_png(std::span<const std::uint8_t> bytes, const std::string& name) {
    constexpr std::size_t signature = 8, around_data = 12; // length, type and checksum, four bytes each
    const auto word = [&](std::size_t at) {
        return std::size_t{bytes[at]} << 24 | std::size_t{bytes[at + 1]} << 16 |
               std::size_t{bytes[at + 2]} << 8 | std::size_t{bytes[at + 3]};
    };
    std::string type;
    for (std::size_t at = signature; type != "IEND";) {
        if (bytes.size() < at + around_data || bytes.size() - at - around_data < word(at)) {
            throw support::input_error("{}: expected a whole PNG image, found it cut off after {} bytes",
                                       name, bytes.size());
        }
        const std::size_t length = word(at);
        type.assign(reinterpret_cast<const char*>(&bytes[at + 4]), 4);
        boost::crc_32_type checksum;
        checksum.process_bytes(&bytes[at + 4], length + 4);
        if (checksum.checksum() != word(at + 8 + length)) {
            throw support::input_error("{}: expected a sound PNG image, found a damaged chunk at byte {}",
                                       name, at);
        }
        at += around_data + length;
    }
}

/// Where red, green, blue and alpha are among a file's channels.
struct Channels {
    std::array<std::size_t, 3> rgb;
    std::optional<std::size_t> alpha;
};

Channels channels_of(const OIIO::ImageSpec& spec, const std::string& name) {
    const auto index = [&](const char* channel) -> std::optional<std::size_t> {
        const int i = spec.channelindex(channel);
        return i < 0 ? std::nullopt : std::optional<std::size_t>(static_cast<std::size_t>(i));
    };
    if (index("R") && index("G") && index("B")) {
        return {{*index("R"), *index("G"), *index("B")}, index("A")};
    }
    if (index("Y")) {
        return {{*index("Y"), *index("Y"), *index("Y")}, index("A")};
    }
    throw support::input_error("{}: expected the channels R, G and B, or Y, found {}", name,
                               support::one_line(fmt::format("{}", fmt::join(spec.channelnames, ", "))));
}

void check_spec(const OIIO::ImageSpec& spec, const std::string& name) {
    if (spec.width < 1 || spec.height < 1 ||
        std::int64_t{spec.width} * std::int64_t{spec.height} > most_pixels) {
        throw support::input_error("{}: expected an image of 1 to {} pixels, found {}x{}", name, most_pixels,
                                   spec.width, spec.height);
    }
    if (spec.deep || spec.depth > 1) {
        throw support::input_error("{}: expected one value a pixel and channel, found a deep image", name);
    }
    if (spec.width != spec.full_width || spec.height != spec.full_height) {
        throw support::input_error("{}: expected pixels for the whole of its {}x{} window, found {}x{}", name,
                                   spec.full_width, spec.full_height, spec.width, spec.height);
    }
}

// More channels than any renderer writes beside colour, in one file.
constexpr int most_channels = 64;

template <typename T>
std::vector<T> read_values(OIIO::ImageInput& input, OIIO::TypeDesc type, const std::string& name) {
    const OIIO::ImageSpec& spec = input.spec();
    if (spec.nchannels > most_channels) {
        throw support::input_error("{}: expected at most {} channels, found {}", name, most_channels,
                                   spec.nchannels);
    }
    std::vector<T> values(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                          static_cast<std::size_t>(spec.nchannels));
    if (!input.read_image(0, 0, 0, spec.nchannels, type, values.data())) {
        throw support::input_error("{}: expected a whole image, found: {}", name, input.geterror());
    }
    return values;
}

/// The sRGB signal in steps of 1/65535, of which 8-bit steps are every 257th, as linear light.
const std::vector<float>& linear_of_signal() {
    static const std::vector<float> table = [] {
        std::vector<float> values(65536);
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] =
                static_cast<float>(renderer::optics::linear_from_srgb(static_cast<double>(i) / 65535));
        }
        return values;
    }();
    return table;
}

void decode_png(OIIO::ImageInput& input, Picture& picture) {
    // OpenImageIO repeats no grey: one or two channels are grey, and grey with alpha.
    const auto channels = static_cast<std::size_t>(input.spec().nchannels);
    const auto values = read_values<std::uint16_t>(input, OIIO::TypeDesc::UINT16, picture.name);
    const bool grey = channels < 3;
    const bool alpha = channels == 2 || channels == 4;
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
        const std::uint16_t* p = &values[i * channels];
        const float cover = alpha ? static_cast<float>(p[channels - 1]) / 65535 : 1;
        for (std::size_t c = 0; c < 3; ++c) {
            picture.linear.push_back(cover * linear_of_signal()[p[grey ? 0 : c]]);
        }
        if (alpha) {
            picture.coverage.push_back(cover);
        }
    }
}

void decode_exr(OIIO::ImageInput& input, Picture& picture) {
    const Channels channels = channels_of(input.spec(), picture.name);
    const auto count = static_cast<std::size_t>(input.spec().nchannels);
    const auto values = read_values<float>(input, OIIO::TypeDesc::FLOAT, picture.name);
    const auto value = [&](std::size_t pixel, std::size_t channel) {
        const float v = values[pixel * count + channel];
        if (!std::isfinite(v)) {
            throw support::input_error("{}: expected finite numbers, found {} at x {}, y {}", picture.name, v,
                                       pixel % static_cast<std::size_t>(picture.width),
                                       pixel / static_cast<std::size_t>(picture.width));
        }
        return v;
    };
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
        for (const std::size_t channel : channels.rgb) {
            picture.linear.push_back(value(i, channel));
        }
        if (channels.alpha) {
            picture.coverage.push_back(value(i, *channels.alpha));
        }
    }
}

using Color = std::array<float, 3>;

Color color_at(const Picture& picture, std::size_t pixel) {
    return {picture.linear[3 * pixel], picture.linear[3 * pixel + 1], picture.linear[3 * pixel + 2]};
}

/// How often each colour stands at the picture's border.
std::map<Color, std::size_t> border_colors(const Picture& picture) {
    std::map<Color, std::size_t> counts;
    const auto width = static_cast<std::size_t>(picture.width);
    const auto height = static_cast<std::size_t>(picture.height);
    for (std::size_t y = 0; y < height; ++y) {
        const bool whole_row = y == 0 || y + 1 == height;
        const std::size_t step = whole_row || width == 1 ? 1 : width - 1;
        for (std::size_t x = 0; x < width; x += step) {
            ++counts[color_at(picture, y * width + x)];
        }
    }
    return counts;
}

/// The colour that the borders of both pictures hold most often, if both hold it.
std::optional<Color> background(const Picture& image, const Picture& reference) {
    const auto first = border_colors(image);
    const auto second = border_colors(reference);
    auto pooled = first;
    for (const auto& [color, count] : second) {
        pooled[color] += count;
    }
    const Color commonest = std::max_element(pooled.begin(), pooled.end(), [](const auto& a, const auto& b) {
                                return a.second < b.second;
                            })->first;
    return first.contains(commonest) && second.contains(commonest) ? std::optional(commonest) : std::nullopt;
}

/// Add the object's pixels of one picture.
void add_object(const Picture& picture, const std::optional<Color>& background,
                std::vector<unsigned char>& object) {
    bool any = false;
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
        const bool covered =
            picture.coverage.empty() ? color_at(picture, i) != background : picture.coverage[i] > 0;
        object[i] |= covered ? 1 : 0;
        any = any || covered;
    }
    if (!any) {
        throw support::input_error("{}: expected an object before a background, found background alone",
                                   picture.name);
    }
}

} // namespace

Picture read_picture(const std::filesystem::path& file) {
    Picture picture;
    picture.name = file.string();
    const std::vector<std::uint8_t> bytes = support::read_bytes(file, largest_file);
    const std::optional<Format> format = format_of(bytes);
    if (!format) {
        throw support::input_error("{}: expected a PNG or OpenEXR image, found {} bytes of something else",
                                   picture.name, bytes.size());
    }
    if (*format == Format::png) {
        check_png(bytes, picture.name);
    }
    OIIO::Filesystem::IOMemReader memory(const_cast<std::uint8_t*>(bytes.data()), bytes.size());
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1;
    void* proxy = &memory;
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    const auto input = OIIO::ImageInput::open(*format == Format::png ? "memory.png" : "memory.exr", &config);
    if (!input) {
        throw support::input_error("{}: expected an image, found: {}", picture.name, OIIO::geterror());
    }
    check_spec(input->spec(), picture.name);
    picture.width = input->spec().width;
    picture.height = input->spec().height;
    picture.linear.reserve(3 * picture.pixels());
    if (*format == Format::png) {
        decode_png(*input, picture);
    } else {
        decode_exr(*input, picture);
    }
    return picture;
}

std::vector<unsigned char> object_pixels(const Picture& image, const Picture& reference) {
    if (image.width != reference.width || image.height != reference.height) {
        throw support::input_error("{}: expected the {}x{} pixels of {}, found {}x{}", image.name,
                                   reference.width, reference.height, reference.name, image.width,
                                   image.height);
    }
    std::vector<unsigned char> object(image.pixels(), 0);
    const std::optional<Color> common = background(image, reference);
    add_object(image, common, object);
    add_object(reference, common, object);
    return object;
}

} // namespace measure
