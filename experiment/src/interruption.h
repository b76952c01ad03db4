// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <csignal>

namespace experiment {

/// While one lives, SIGINT, SIGTERM and SIGHUP ask the session to end instead of ending the program; make at
/// most one at a time.
class Interruption {
public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    /// Throws Interrupted if a signal has arrived.
    static void check();

private:
    std::array<struct sigaction, 3> previous_{};
};

} // namespace experiment
