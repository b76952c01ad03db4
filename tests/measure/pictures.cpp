// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "pictures.h"

#include <algorithm>
#include <stdexcept>

#include <OpenImageIO/imageio.h>
#include <stdlib.h>

#include <renderer/optics/color.h>
#include <support/random.h>

namespace pictures {
namespace {

namespace fs = std::filesystem;
using measure::Picture;

void push(Picture& picture, const Rgb8& color) {
    for (const std::uint8_t value : color) {
        picture.linear.push_back(static_cast<float>(renderer::optics::linear_from_srgb(value / 255.0)));
    }
}

void write(const fs::path& file, int width, int height, int channels, OIIO::TypeDesc type,
           const void* values) {
    OIIO::ImageSpec spec(width, height, channels, type);
    spec["oiio:UnassociatedAlpha"] = 1;
    if (channels < 3) {
        spec.channelnames[0] = "Y";
    }
    if (channels == 2) {
        spec.channelnames[1] = "A";
        spec.alpha_channel = 1;
    }
    const auto output = OIIO::ImageOutput::create(file.string());
    if (!output || !output->open(file.string(), spec) || !output->write_image(type, values) ||
        !output->close()) {
        throw std::runtime_error(file.string());
    }
}

} // namespace

Picture constant(int width, int height, const Rgb8& color) {
    Picture picture{"constant", width, height, {}, {}};
    for (int i = 0; i < width * height; ++i) {
        push(picture, color);
    }
    return picture;
}

Picture checker(int width, int height, int shift_x, int shift_y) {
    Picture picture{"checker", width, height, {}, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int column = (x - shift_x + width) % width / 16;
            const int row = (y - shift_y + height) % height / 16;
            push(picture, (column + row) % 2 == 0 ? Rgb8{51, 102, 153} : Rgb8{179, 128, 77});
        }
    }
    return picture;
}

Picture disc(int side, double radius, float scale) {
    Picture picture{"disc", side, side, {}, {}};
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const double dx = x + 0.5 - side / 2.0;
            const double dy = y + 0.5 - side / 2.0;
            picture.linear.insert(picture.linear.end(), 3,
                                  dx * dx + dy * dy < radius * radius ? 0.5f * scale : 0.0f);
        }
    }
    return picture;
}

Picture noisy(Picture picture, double sigma, std::uint64_t seed) {
    support::Generator generator("noise", seed);
    for (float& value : picture.linear) {
        value = std::max(0.0f, value + static_cast<float>(sigma * generator.normal()));
    }
    return picture;
}

Folder::Folder() {
    std::string name = (fs::temp_directory_path() / "skin2afc-test-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
}

Folder::~Folder() { fs::remove_all(path_); }

std::vector<std::string> Folder::files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(path_)) {
        names.push_back(fs::relative(entry.path(), path_).string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

void write_png8(const fs::path& file, int width, int height, int channels,
                const std::vector<std::uint8_t>& values) {
    write(file, width, height, channels, OIIO::TypeDesc::UINT8, values.data());
}

void write_png16(const fs::path& file, int width, int height, int channels,
                 const std::vector<std::uint16_t>& values) {
    write(file, width, height, channels, OIIO::TypeDesc::UINT16, values.data());
}

void write_exr(const fs::path& file, int width, int height, int channels, const std::vector<float>& values) {
    write(file, width, height, channels, OIIO::TypeDesc::FLOAT, values.data());
}

void write_square(const fs::path& file, const Rgb8& color) {
    std::vector<std::uint8_t> values;
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 32; ++x) {
            const bool inside = x >= 8 && x < 24 && y >= 8 && y < 16;
            for (const std::uint8_t value : color) {
                values.push_back(inside ? value : std::uint8_t{10});
            }
        }
    }
    write_png8(file, 32, 24, 3, values);
}

} // namespace pictures
