// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

#include "procedure.h"
#include "session.h"
#include "stage.h"

namespace experiment {

/// What a test of the timing measured.
struct TimingFindings {
    std::string monitor, pacing;             ///< as StageFacts has them
    double refresh_hz = 0, refresh_sd_s = 0; ///< rate of swaps, and the SD of their intervals
    double grey_s = 0;                       ///< asked for
    std::vector<double> grey_error_s;        ///< of each cycle: how much longer the grey was
    std::vector<double> swap_s;              ///< how long each swap took
    int dropped_frames = 0;
};

/// The findings in words: what was measured, how to read it, what is acceptable and whether it was reached.
std::string timing_report(const TimingFindings& findings);

/// Print how exact a session before a screen was whose greys were asked for `grey_s`, and warn where that is
/// not acceptable by the rules of the timing test.
void tell_timing(const StageFacts& facts, double grey_s, const Timing& timing);

/// Show grey and pictures in turn for so many seconds and print the report. Throws as a session does, and
/// support::Failure where the timing is not acceptable.
void run_timing_test(const SessionOptions& options, double seconds);

} // namespace experiment
