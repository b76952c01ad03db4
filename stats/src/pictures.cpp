// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <png.h>

#include <support/error.h>
#include <support/file.h>

namespace stats {
namespace {

constexpr std::uintmax_t largest_picture = std::uintmax_t{256} << 20;
constexpr int thumbnail_width = 240;

std::optional<std::filesystem::path> stimulus(const std::filesystem::path& stimuli, const std::string& shader,
                                              const Condition& condition) {
    const double azimuth = condition.azimuth_deg;
    if (azimuth < 0 || azimuth != std::floor(azimuth)) {
        return std::nullopt;
    }
    return stimuli / fmt::format("{}_{}_{:03}.png", shader, condition.distance, static_cast<int>(azimuth));
}

} // namespace

std::optional<std::string> read_png(const std::filesystem::path& file) {
    using namespace std::string_view_literals;
    std::error_code ignored;
    if (!std::filesystem::exists(std::filesystem::symlink_status(file, ignored))) {
        return std::nullopt;
    }
    // A PNG starts with its signature and ends with an empty IEND chunk [PNG2003, sections 5.2 and 11.2.5].
    std::string bytes = support::read_text(file, largest_picture);
    if (!bytes.starts_with("\x89PNG\r\n\x1a\n"sv) || !bytes.ends_with("\0\0\0\0IEND\xae\x42\x60\x82"sv)) {
        throw support::input_error("{}: expected a whole PNG picture, found something else", file.string());
    }
    return bytes;
}

Picture decoded(const std::string& png, const std::string& name) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    Picture picture;
    if (png_image_begin_read_from_memory(&image, png.data(), png.size()) != 0) {
        image.format = PNG_FORMAT_RGB;
        picture.width = static_cast<int>(image.width);
        picture.height = static_cast<int>(image.height);
        picture.rgb.resize(PNG_IMAGE_SIZE(image));
        png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr);
    }
    const bool failed = PNG_IMAGE_FAILED(image);
    const std::string why = image.message;
    png_image_free(&image);
    if (failed) {
        throw support::input_error("{}: expected a PNG picture, found: {}", name, why);
    }
    return picture;
}

std::string encoded(const Picture& picture) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string bytes(size, '\0');
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr) == 0) {
        throw support::failure("a picture cannot be encoded: {}", image.message);
    }
    bytes.resize(size);
    return bytes;
}

Picture thumbnail(const Picture& picture, int width) {
    const int shrink = std::max(1, (picture.width + width - 1) / width);
    Picture small{picture.width / shrink, picture.height / shrink, {}};
    const int pixels = shrink * shrink;
    for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < 3 * small.width; ++x) {
            int sum = 0;
            for (int row = y * shrink; row < (y + 1) * shrink; ++row) {
                const std::size_t start =
                    3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width) +
                         static_cast<std::size_t>(x / 3 * shrink)) +
                    static_cast<std::size_t>(x % 3);
                for (int column = 0; column < shrink; ++column) {
                    sum += picture.rgb[start + 3 * static_cast<std::size_t>(column)];
                }
            }
            small.rgb.push_back(static_cast<std::uint8_t>((sum + pixels / 2) / pixels));
        }
    }
    return small;
}

Picture difference(const Picture& a, const Picture& b, double gain) {
    constexpr double brightest = 255;
    Picture result{a.width, a.height, std::vector<std::uint8_t>(a.rgb.size())};
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        result.rgb[i] = static_cast<std::uint8_t>(std::min(brightest, gain * std::abs(a.rgb[i] - b.rgb[i])));
    }
    return result;
}

std::vector<std::optional<ConditionPictures>> condition_pictures(std::span<const Row> rows,
                                                                 const std::filesystem::path& stimuli) {
    // Rows of one configuration share the reference's picture; keep the last one decoded.
    std::filesystem::path reference_file;
    std::optional<Picture> reference;
    const auto load = [](const std::filesystem::path& file) -> std::optional<Picture> {
        const auto png = read_png(file);
        return png ? std::optional(decoded(*png, file.string())) : std::nullopt;
    };
    std::vector<std::optional<ConditionPictures>> result;
    for (const Row& row : rows) {
        result.emplace_back();
        const auto first = stimulus(stimuli, row.condition.reference, row.condition);
        const auto second = stimulus(stimuli, row.condition.test, row.condition);
        if (!first || !second) {
            continue;
        }
        if (*first != reference_file) {
            reference_file = *first;
            reference = load(*first);
        }
        const auto test = load(*second);
        if (!reference || !test || reference->width != test->width || reference->height != test->height) {
            continue;
        }
        const auto small = [](const Picture& picture) {
            return encoded(thumbnail(picture, thumbnail_width));
        };
        result.back() = {small(*reference), small(*test),
                         small(difference(*reference, *test, difference_gain))};
    }
    return result;
}

} // namespace stats
