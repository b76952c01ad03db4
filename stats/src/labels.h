// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <stats/log.h>

namespace stats {

/// A shader's name as the paper prints it ("SS Full"); an unknown one as it stands.
std::string shader_label(const std::string& shader);

/// A distance's name with a capital ("Far").
std::string distance_label(const std::string& distance);

/// "60°" in UTF-8.
std::string azimuth_label(double azimuth_deg);

/// A configuration as the paper's Table II prints it: "TS - Far - 0°".
std::string configuration_label(const std::string& reference, const std::string& distance,
                                double azimuth_deg);

/// A number that reads back exactly: the shortest round trip, inf, -inf, or n/a for what is no number.
std::string exact(double value);

/// A statistic to three decimals without trailing zeros, as Table II prints it: 21.125, 18, 0.
std::string statistic_text(double value);

/// A p-value to three decimals, and 1 for one of exactly 1, as Table II prints it: 0.000, 0.480, 1.
std::string p_text(double p);

/// A p-value for running text: "= 0.034" or "< 0.001"; never the level of .05 for one above it ("= 0.0501").
std::string p_phrase(double p);

/// "1 answer", "2 answers"; of all there are, "the only row", "the 2 rows".
std::string counted(std::size_t count, std::string_view noun);
std::string all_counted(std::size_t count, std::string_view noun);

/// "a, b and c"; a long list ends in "and 7 others". Not for an empty one.
std::string listed(std::vector<std::string> items);

} // namespace stats
