// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace measure {

/// Two files to compare, and the stem of what is written about them.
struct Pair {
    std::string stem;
    std::filesystem::path image, reference;
};

/// How folders are searched.
struct PairingRules {
    std::string
        against; ///< compare with this shader's image of the same view; empty: with the same file name
    bool png_only = false; ///< leave linear images (.exr) aside
};

/// The pairs of two files, or of two folders: every image of the one with its twin in the other. Of a folder
/// with a manifest the images it lists count, of another every .png and .exr but contact_sheet.png. Where
/// both twins have linear images beside their PNGs, those are taken. Throws support::InputError for a file
/// with a folder, no image, and a missing twin.
std::vector<Pair> find_pairs(const std::filesystem::path& image, const std::filesystem::path& reference,
                             const PairingRules& rules);

} // namespace measure
