// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

namespace support {

/// Progress of a known number of steps, on stderr: a bar with the time left on a terminal, one plain line a
/// step elsewhere.
class Progress {
public:
    Progress(std::string label, std::size_t steps);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Say that one more step is done.
    void step(std::string_view what);

private:
    std::string label_;
    std::size_t steps_, done_ = 0;
    bool terminal_;
    std::chrono::steady_clock::time_point start_;
};

} // namespace support
