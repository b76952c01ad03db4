// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "contact_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <renderer/optics/color.h>
#include <renderer/scene/image_file.h>
#include <support/text_raster.h>

#include "picture_file.h"

namespace stimuli {
namespace {

namespace fs = std::filesystem;
using renderer::passes::Frame;

constexpr int widest_thumbnail = 420, gap = 6, margin = 12, heading_height = 40, font_px = 20;
constexpr std::uint8_t paper = 30, ink = 220;

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

/// Paste an image, `shrink` times smaller: each pixel is the mean light of shrink x shrink pixels.
void paste_thumbnail(Frame& sheet, int left, int top, const fs::path& file, int shrink) {
    const renderer::scene::ImagePtr image = renderer::scene::read_image(file);
    std::array<float, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i) {
        linear[i] = static_cast<float>(renderer::optics::linear_from_srgb(static_cast<double>(i) / 255));
    }
    const auto channels = static_cast<std::size_t>(image->channels);
    for (int y = 0; y < image->height / shrink; ++y) {
        for (int x = 0; x < image->width / shrink; ++x) {
            for (std::size_t c = 0; c < 3; ++c) {
                float sum = 0;
                for (int i = 0; i < shrink * shrink; ++i) {
                    const int row = y * shrink + i / shrink;
                    const int column = x * shrink + i % shrink;
                    sum += linear
                        [image->pixels[static_cast<std::size_t>(row * image->width + column) * channels + c]];
                }
                const double mean = static_cast<double>(sum) / (shrink * shrink);
                pixel(sheet, left + x, top + y)[c] =
                    static_cast<std::uint8_t>(std::lround(255 * renderer::optics::srgb_from_linear(mean)));
            }
        }
    }
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

void write_contact_sheet(const fs::path& folder, const study::Protocol& protocol) {
    const int shrink = (protocol.image.width + widest_thumbnail - 1) / widest_thumbnail;
    const int label_width = label_column_width(protocol);
    const int cell_width = protocol.image.width / shrink + gap;
    const int cell_height = protocol.image.height / shrink + gap;
    const auto columns = static_cast<int>(protocol.shaders.size());
    const auto rows = static_cast<int>(protocol.camera.distances.size() * protocol.light.azimuths_deg.size());
    Frame sheet;
    sheet.width = label_width + columns * cell_width;
    sheet.height = heading_height + rows * cell_height;
    sheet.srgb.assign(3 * static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height),
                      paper);

    int column = 0;
    for (const std::string& shader : protocol.shaders) {
        const int left = label_width + column * cell_width;
        label(sheet, left + cell_width / 2, heading_height / 2, shader, 0.5);
        int row = 0;
        for (const study::Distance& distance : protocol.camera.distances) {
            for (const int azimuth : protocol.light.azimuths_deg) {
                const int top = heading_height + row * cell_height;
                const std::string name = study::stimulus_name(shader, distance.name, azimuth);
                paste_thumbnail(sheet, left, top, folder / (name + ".png"), shrink);
                if (column == 0) {
                    label(sheet, label_width - margin, top + cell_height / 2, view_label(distance, azimuth),
                          1);
                }
                ++row;
            }
        }
        ++column;
    }
    write_png(folder / "contact_sheet.png", sheet);
}

} // namespace stimuli
