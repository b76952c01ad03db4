// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <stats/table.h>

namespace stats {

/// The bytes of a PNG file, if there is one. Throws support::InputError for a file that is no whole PNG.
std::optional<std::string> read_png(const std::filesystem::path& file);

/// A picture as displayed: 8-bit red, green and blue, rows from the top down.
struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
};

/// Decode a PNG; throws support::InputError, which `name` stands in, for one that cannot be.
Picture decoded(const std::string& png, const std::string& name);
std::string encoded(const Picture& picture);

/// The picture at this width or less: each pixel is the mean of the square it covers.
Picture thumbnail(const Picture& picture, int width);

/// The absolute difference of the display's signals, times the gain; both of one size.
Picture difference(const Picture& a, const Picture& b, double gain);

/// Contrast of difference pictures [Jimenez2009, Figure 9].
inline constexpr double difference_gain = 75;

/// What stands beside a condition's numbers, as PNGs.
struct ConditionPictures {
    std::string reference, test, difference;
};

/// The folders in which a study keeps copies of the pictures shown, those of most runs first, then its folder
/// of stimuli itself; they need not be there.
std::vector<std::filesystem::path> kept_stimuli(const Study& study, const std::filesystem::path& folder);

/// The pictures of each row, in the rows' order, from the files <shader>_<distance>_<azimuth, 3 digits>.png
/// of the first folder that has both in one size; nothing where none has. Throws support::InputError for one
/// that is no PNG.
std::vector<std::optional<ConditionPictures>>
condition_pictures(std::span<const Row> rows, std::span<const std::filesystem::path> folders);

} // namespace stats
