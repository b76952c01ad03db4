// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "contact_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <renderer/optics/color.h>
#include <renderer/scene/image_file.h>
#include <support/error.h>
#include <support/text_raster.h>

#include "picture_file.h"

namespace stimuli {
namespace {

namespace fs = std::filesystem;
using renderer::passes::Frame;

constexpr int widest_thumbnail = 420, gap = 6, margin = 12, heading_height = 40, font_px = 20;
constexpr std::uint8_t paper = 30, ink = 220;
constexpr std::size_t most_pixels = std::size_t{64} << 20; // 192 MB

std::uint8_t* pixel(Frame& sheet, int x, int y) {
    return &sheet.srgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(sheet.width) +
                            static_cast<std::size_t>(x))];
}

/// Write text with its middle at the height `y`; `anchor` is the share of its width that lies left of `x`.
void label(Frame& sheet, int x, int y, const std::string& text, double anchor) {
    const support::TextRaster raster = support::text_raster(text, font_px);
    const int left = x - static_cast<int>(std::lround(anchor * raster.width));
    const int top = y - raster.height / 2;
    for (int row = 0; row < raster.height; ++row) {
        for (int column = 0; column < raster.width; ++column) {
            if (left + column < 0 || left + column >= sheet.width || top + row < 0 ||
                top + row >= sheet.height) {
                continue;
            }
            const int cover = raster.coverage[static_cast<std::size_t>(row * raster.width + column)];
            std::uint8_t* p = pixel(sheet, left + column, top + row);
            for (int c = 0; c < 3; ++c) {
                p[c] = static_cast<std::uint8_t>(p[c] + (ink - p[c]) * cover / 255);
            }
        }
    }
}

/// The light of each 8-bit level.
const std::array<float, 256>& light_of_levels() {
    static const auto table = [] {
        std::array<float, 256> light{};
        for (std::size_t i = 0; i < light.size(); ++i) {
            light[i] = static_cast<float>(renderer::optics::linear_from_srgb(static_cast<double>(i) / 255));
        }
        return light;
    }();
    return table;
}

long level_of_light(double light) { return std::lround(255 * renderer::optics::srgb_from_linear(light)); }

/// The least light, of all doubles, that is shown as each level: found by halving, as levels grow with light.
const std::array<double, 256>& least_light_of_levels() {
    static const auto table = [] {
        std::array<double, 256> least{};
        for (std::size_t level = 1; level < least.size(); ++level) {
            double below = 0;
            double above = 1;
            for (double middle = 0.5; below < middle && middle < above; middle = 0.5 * (below + above)) {
                (level_of_light(middle) < static_cast<long>(level) ? below : above) = middle;
            }
            least[level] = above;
        }
        return least;
    }();
    return table;
}

/// The text beside a view's row.
std::string view_label(const study::Distance& distance, int azimuth_deg) {
    return fmt::format("{} {}°", distance.name, azimuth_deg);
}

/// Room for the widest row label, with a margin on both sides.
int label_column_width(const study::Protocol& protocol) {
    int widest = 0;
    for (const study::Distance& distance : protocol.camera.distances) {
        for (const int azimuth : protocol.light.azimuths_deg) {
            widest = std::max(widest, support::text_width(view_label(distance, azimuth), font_px));
        }
    }
    return widest + 2 * margin;
}

} // namespace

ContactSheet::ContactSheet(const study::Protocol& protocol)
    : width_(protocol.image.width), height_(protocol.image.height),
      shrink_((width_ + widest_thumbnail - 1) / widest_thumbnail) {
    const int label_width = label_column_width(protocol);
    const std::size_t columns = protocol.shaders.size();
    const std::size_t rows = protocol.camera.distances.size() * protocol.light.azimuths_deg.size();
    const auto sheet_pixels = [&](int shrink) {
        return (static_cast<std::size_t>(label_width) +
                columns * static_cast<std::size_t>(width_ / shrink + gap)) *
               (heading_height + rows * static_cast<std::size_t>(height_ / shrink + gap));
    };
    while (sheet_pixels(shrink_) > most_pixels && shrink_ < std::min(width_, height_)) {
        ++shrink_;
    }
    const int cell_width = width_ / shrink_ + gap;
    const int cell_height = height_ / shrink_ + gap;
    sheet_.width = label_width + static_cast<int>(columns) * cell_width;
    sheet_.height = heading_height + static_cast<int>(rows) * cell_height;
    sheet_.srgb.assign(3 * static_cast<std::size_t>(sheet_.width) * static_cast<std::size_t>(sheet_.height),
                       paper);

    int left = label_width;
    for (const std::string& shader : protocol.shaders) {
        label(sheet_, left + cell_width / 2, heading_height / 2, shader, 0.5);
        int top = heading_height;
        for (const study::Distance& distance : protocol.camera.distances) {
            for (const int azimuth : protocol.light.azimuths_deg) {
                cells_.push_back({study::stimulus_name(shader, distance.name, azimuth), left, top});
                if (left == label_width) {
                    label(sheet_, label_width - margin, top + cell_height / 2, view_label(distance, azimuth),
                          1);
                }
                top += cell_height;
            }
        }
        left += cell_width;
    }
}

void ContactSheet::paste(const std::string& name, const std::uint8_t* pixels, int channels) {
    const auto cell = std::find_if(cells_.begin(), cells_.end(),
                                   [&](const Cell& candidate) { return candidate.name == name; });
    if (cell == cells_.end()) {
        return;
    }
    // Each pixel of the sheet is the mean light of shrink x shrink pixels.
    const std::array<float, 256>& light = light_of_levels();
    const std::array<double, 256>& least = least_light_of_levels();
    const int columns = width_ / shrink_;
    std::vector<float> sums(3 * static_cast<std::size_t>(columns));
    for (int y = 0; y < height_ / shrink_; ++y) {
        std::fill(sums.begin(), sums.end(), 0.0f);
        for (int row = y * shrink_; row < (y + 1) * shrink_; ++row) {
            const std::uint8_t* p =
                pixels + static_cast<std::size_t>(row) * static_cast<std::size_t>(width_ * channels);
            for (float* sum = sums.data(); sum != sums.data() + sums.size(); sum += 3) {
                for (int i = 0; i < shrink_; ++i, p += channels) {
                    sum[0] += light[p[0]];
                    sum[1] += light[p[1]];
                    sum[2] += light[p[2]];
                }
            }
        }
        std::uint8_t* target = pixel(sheet_, cell->left, cell->top + y);
        for (const float sum : sums) {
            const double mean = static_cast<double>(sum) / (shrink_ * shrink_);
            const auto above = std::upper_bound(least.begin(), least.end(), mean);
            *target++ = static_cast<std::uint8_t>(above - least.begin() - 1);
        }
    }
    cell->pasted = true;
}

void ContactSheet::write(const fs::path& folder) {
    for (const Cell& cell : cells_) {
        if (!cell.pasted) {
            const fs::path file = folder / (cell.name + ".png");
            const renderer::scene::ImagePtr image = renderer::scene::read_image(file);
            if (image->width != width_ || image->height != height_) {
                throw support::input_error("{}: expected {}x{} pixels, found {}x{}", file.string(), width_,
                                           height_, image->width, image->height);
            }
            paste(cell.name, image->pixels.data(), image->channels);
        }
    }
    write_png(folder / "contact_sheet.png", sheet_);
}

} // namespace stimuli
