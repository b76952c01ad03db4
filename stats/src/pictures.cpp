// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

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

/// Reads pictures and keeps the last reference: rows of one configuration share it.
class PictureReader {
public:
    static std::optional<Picture> read(const std::filesystem::path& file) {
        const auto png = read_png(file);
        return png ? std::optional(decoded(*png, file.string())) : std::nullopt;
    }

    const std::optional<Picture>& reference(const std::filesystem::path& file) {
        if (file != file_) {
            picture_ = read(file);
            file_ = file;
        }
        return picture_;
    }

private:
    std::filesystem::path file_;
    std::optional<Picture> picture_;
};

std::optional<ConditionPictures> pictures_in(const std::filesystem::path& folder, const Condition& condition,
                                             PictureReader& reader) {
    const auto first = stimulus(folder, condition.reference, condition);
    const auto second = stimulus(folder, condition.test, condition);
    if (!first || !second) {
        return std::nullopt;
    }
    const std::optional<Picture>& reference = reader.reference(*first);
    const auto test = PictureReader::read(*second);
    if (!reference || !test || reference->width != test->width || reference->height != test->height) {
        return std::nullopt;
    }
    const auto small = [](const Picture& picture) { return encoded(thumbnail(picture, thumbnail_width)); };
    return ConditionPictures{small(*reference), small(*test),
                             small(difference(*reference, *test, difference_gain))};
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

std::vector<std::filesystem::path> kept_stimuli(const Study& study, const std::filesystem::path& folder) {
    std::map<std::string, std::size_t> runs;
    for (const Run& run : study.runs) {
        if (run.used && !run.sidecar.stimuli.empty()) {
            ++runs[run.sidecar.stimuli];
        }
    }
    std::vector<std::pair<std::string, std::size_t>> by_runs(runs.begin(), runs.end());
    std::stable_sort(by_runs.begin(), by_runs.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    std::vector<std::filesystem::path> folders;
    for (const auto& [digits, count] : by_runs) {
        folders.push_back(folder / "stimuli" / digits);
    }
    folders.push_back(folder / "stimuli");
    return folders;
}

std::vector<std::optional<ConditionPictures>>
condition_pictures(std::span<const Row> rows, std::span<const std::filesystem::path> folders) {
    PictureReader reader;
    std::vector<std::optional<ConditionPictures>> result;
    for (const Row& row : rows) {
        result.emplace_back();
        for (auto folder = folders.begin(); folder != folders.end() && !result.back(); ++folder) {
            result.back() = pictures_in(*folder, row.condition, reader);
        }
    }
    return result;
}

} // namespace stats
