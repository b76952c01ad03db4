// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stats {

/// What one comparison showed: two shaders, seen from one distance under one light.
struct Condition {
    std::string reference, test; ///< shaders
    std::string distance;        ///< the camera distance's name
    double azimuth_deg = 0;      ///< of the light
    bool operator==(const Condition&) const = default;
};

/// One trial as the log has it.
struct Trial {
    std::int64_t number = 0; ///< 1, 2, ... in the order shown
    Condition condition;
    bool reference_first = true;          ///< the first interval showed the reference
    std::optional<bool> reference_chosen; ///< absent when there is no answer (n/a)
    /// Seconds: from the onset of the second picture to the key; since the session's start.
    std::optional<double> response_time_s, onset_first_s, onset_grey_s, onset_second_s;

    /// Whether the answer was the first interval; absent without an answer.
    std::optional<bool> first_chosen() const {
        return reference_chosen ? std::optional(*reference_chosen == reference_first) : std::nullopt;
    }
};

/// A line that is not counted.
struct SetAside {
    std::size_t line = 0; ///< 1 is the header
    std::string why;
};

/// A run's trials.
struct Log {
    std::vector<Trial> trials;
    std::optional<SetAside> torn; ///< a last line that was cut off
};

/// Parse the text of a `_beh.tsv`. `name` stands for the file in errors.
/// Throws support::InputError "FILE:LINE: ..." for the first line that is not as the format has it; only a
/// torn last line (no line break at its end, or too few fields) is set aside.
Log parse_log(std::string_view text, const std::string& name);

/// Read a `_beh.tsv`; errors as parse_log and support::read_text.
Log read_log(const std::filesystem::path& file);

} // namespace stats
