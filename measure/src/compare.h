// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <measure/errors.h>

#include "pairs.h"

namespace measure {

/// What to compare, and how.
struct CompareRequest {
    std::filesystem::path image, reference; ///< two files, or two folders
    std::optional<std::filesystem::path> out;
    double gain = 75; ///< of the difference pictures [Jimenez2009, Fig. 9]
    double pixels_per_degree = default_pixels_per_degree();
    PairingRules rules;
};

/// The errors of one pair.
struct ErrorRow {
    std::string image, reference; ///< file names
    Errors errors;
};

/// Measure every pair and, where asked for, write errors.tsv and the pictures, all or none.
/// Throws support::InputError and support::Failure.
std::vector<ErrorRow> compare(const CompareRequest& request);

/// The table as tab-separated text; numbers read back exactly.
std::string to_tsv(const std::vector<ErrorRow>& rows);
/// The table for people.
std::string to_text(const std::vector<ErrorRow>& rows);

/// The columns of the errors in tables, and their values in that order.
extern const std::vector<std::string> error_columns;
std::vector<std::string> error_values(const Errors& errors);

} // namespace measure
