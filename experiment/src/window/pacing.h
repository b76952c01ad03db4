// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <vector>

namespace experiment {

/// Seconds on CLOCK_MONOTONIC, which no one sets back.
double monotonic_s();

/// Sleep until the deadline, or until a signal; the system wakes the sleeper a little late.
void sleep_until(double deadline_s);

/// Sleep until shortly before the deadline and spin the rest.
void wait_until(double deadline_s);

/// What a display's buffer swaps tell of its refresh.
struct Refresh {
    bool vsync = false; ///< swaps wait for the refresh
    double hz = 0;      ///< measured rate of swaps
    double sd_s = 0;    ///< standard deviation of the intervals between swaps
};

/// Judge consecutive swap times (at least three). Swaps wait for the refresh if their intervals are equal
/// (SD < 1 ms), their rate is one that displays have (24 to 500 Hz), and the rate is the one that the monitor
/// reports: a monitor that reports none, 0 Hz, has no refresh to wait for.
Refresh judge_refresh(std::span<const double> swap_times_s, double reported_hz);

/// The rate of swaps that each wait for a refresh, by least squares over all of them; `hz` is near it, so
/// that refreshes that were missed between two swaps can be counted.
double rate_of(std::span<const double> swap_times_s, double hz);

/// How many refreshes were missed before each of consecutive swaps but the first. A swap that was only
/// noticed late, so that the next seem to come early, missed none: their refreshes are counted from the
/// first swap on.
std::vector<int> missed_refreshes(std::span<const double> swap_times_s, double hz);

/// How many frames a grey of that duration lasts: a whole number, at least one.
int whole_frames(double duration_s, double hz);

/// How many frames came too late: 0 unless the interval exceeds the `expected` frames by a fifth of a period
/// (an interval of one frame counts as dropped from 1.2 periods).
int missed_frames(double interval_s, int expected, double hz);

/// The median of at least one value.
double median(std::vector<double> values);

} // namespace experiment
