// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

#include "../schedule.h"

namespace experiment {

namespace fs = std::filesystem;

/// What a log holds.
struct LogContent {
    std::vector<Trial> trials; ///< answered, in the order of the lines
    double last_s = 0;         ///< the last answer, in seconds since the session's start
    off_t whole = 0;           ///< bytes of whole lines, the last one's end perhaps missing
    std::string torn;          ///< what follows them: an answer that was being written
};

/// Read a log. Throws support::InputError that names file, line, column, expectation and finding for a line
/// that this program did not write so.
LogContent read_log(const fs::path& file);

/// Hold a log's trials against the order that was planned. Throws support::InputError that names file and
/// line.
void check_order(const LogContent& content, const Schedule& schedule, const fs::path& file);

} // namespace experiment
