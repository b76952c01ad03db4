// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <string_view>

/// One cell of [Jimenez2009, Table II]: chi-square and p as printed, and the count that the printed
/// chi-square implies for n = 32 (the larger of k and n - k).
struct PublishedCell {
    std::string_view test, distance;
    int azimuth_deg, reference_chosen;
    std::string_view chi_square, p;
};

inline constexpr int published_participants = 16; ///< each saw every pair in both orders: n = 32

// clang-format off
inline constexpr std::array<PublishedCell, 36> published_table2{{
    {"no_sss", "far", 0, 29, "21.125", "0.000"},
    {"ss_jittered", "far", 0, 29, "21.125", "0.000"},
    {"ss_full", "far", 0, 21, "3.125", "0.077"},
    {"no_sss", "far", 60, 31, "28.125", "0.000"},
    {"ss_jittered", "far", 60, 28, "18", "0.000"},
    {"ss_full", "far", 60, 21, "3.125", "0.077"},
    {"no_sss", "far", 110, 30, "24.5", "0.000"},
    {"ss_jittered", "far", 110, 27, "15.125", "0.000"},
    {"ss_full", "far", 110, 17, "0.125", "0.724"},
    {"no_sss", "far", 150, 32, "32", "0.000"},
    {"ss_jittered", "far", 150, 27, "15.125", "0.000"},
    {"ss_full", "far", 150, 16, "0", "1"},
    {"no_sss", "near", 0, 32, "32", "0.000"},
    {"ss_jittered", "near", 0, 31, "28.125", "0.000"},
    {"ss_full", "near", 0, 16, "0", "1"},
    {"no_sss", "near", 60, 32, "32", "0.000"},
    {"ss_jittered", "near", 60, 31, "28.125", "0.000"},
    {"ss_full", "near", 60, 17, "0.125", "0.724"},
    {"no_sss", "near", 110, 30, "24.5", "0.000"},
    {"ss_jittered", "near", 110, 31, "28.125", "0.000"},
    {"ss_full", "near", 110, 19, "1.125", "0.289"},
    {"no_sss", "near", 150, 32, "32", "0.000"},
    {"ss_jittered", "near", 150, 29, "21.125", "0.000"},
    {"ss_full", "near", 150, 17, "0.125", "0.724"},
    {"no_sss", "zoom", 0, 31, "28.125", "0.000"},
    {"ss_jittered", "zoom", 0, 31, "28.125", "0.000"},
    {"ss_full", "zoom", 0, 18, "0.5", "0.480"},
    {"no_sss", "zoom", 60, 31, "28.125", "0.000"},
    {"ss_jittered", "zoom", 60, 28, "18", "0.000"},
    {"ss_full", "zoom", 60, 20, "2", "0.157"},
    {"no_sss", "zoom", 110, 32, "32", "0.000"},
    {"ss_jittered", "zoom", 110, 27, "15.125", "0.000"},
    {"ss_full", "zoom", 110, 22, "4.5", "0.034"},
    {"no_sss", "zoom", 150, 32, "32", "0.000"},
    {"ss_jittered", "zoom", 150, 28, "18", "0.000"},
    {"ss_full", "zoom", 150, 18, "0.5", "0.480"},
}};
// clang-format on
