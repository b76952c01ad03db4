// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace support {

/// Accepts a number from `least` to `most` as an option's value; CLI::Range takes "nan" for one.
inline CLI::Validator number_range(double least, double most) {
    const auto check = [least, most](std::string& text) -> std::string {
        double value = 0;
        if (!CLI::detail::lexical_cast(text, value) || !(value >= least && value <= most)) {
            return fmt::format("Value {} not in range {} to {}", text, least, most);
        }
        return {};
    };
    return CLI::Validator(check, fmt::format("in [{} - {}]", least, most));
}

} // namespace support
