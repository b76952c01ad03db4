// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "pacing.h"

#include <algorithm>
#include <cmath>

#include <time.h>

namespace experiment {
namespace {

constexpr double largest_sd_s = 1e-3, lowest_hz = 24, highest_hz = 500;
constexpr double reported_tolerance = 0.1; // monitors report whole hertz: 59.94 as 59, 23.976 as 23
constexpr double late_share = 0.2;         // of a period
constexpr double spin_s = 1.5e-3;          // longer than a timer is late on an idle machine

} // namespace

double monotonic_s() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void sleep_until(double deadline_s) {
    const double whole = std::floor(deadline_s);
    timespec deadline{};
    deadline.tv_sec = static_cast<time_t>(whole);
    deadline.tv_nsec = static_cast<long>((deadline_s - whole) * 1e9);
    ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr);
}

void wait_until(double deadline_s) {
    sleep_until(deadline_s - spin_s);
    while (monotonic_s() < deadline_s) {
    }
}

Refresh judge_refresh(std::span<const double> swap_times_s, double reported_hz) {
    const auto intervals = static_cast<double>(swap_times_s.size() - 1);
    const double mean_s = (swap_times_s.back() - swap_times_s.front()) / intervals;
    double squares = 0;
    for (std::size_t i = 1; i < swap_times_s.size(); ++i) {
        const double deviation = swap_times_s[i] - swap_times_s[i - 1] - mean_s;
        squares += deviation * deviation;
    }
    Refresh refresh{.vsync = false, .hz = 1 / mean_s, .sd_s = std::sqrt(squares / (intervals - 1))};
    refresh.vsync = refresh.sd_s < largest_sd_s && refresh.hz >= lowest_hz && refresh.hz <= highest_hz &&
                    std::abs(refresh.hz - reported_hz) <= reported_tolerance * reported_hz;
    return refresh;
}

double rate_of(std::span<const double> swap_times_s, double hz) {
    // The slope of the refreshes' numbers over their times.
    const auto count = static_cast<double>(swap_times_s.size());
    double number = 0, sum_n = 0, sum_t = 0, sum_nt = 0, sum_tt = 0;
    for (std::size_t i = 0; i < swap_times_s.size(); ++i) {
        const double t_s = swap_times_s[i] - swap_times_s[0];
        if (i > 0) {
            number += std::max(1.0, std::round((swap_times_s[i] - swap_times_s[i - 1]) * hz));
        }
        sum_n += number;
        sum_t += t_s;
        sum_nt += number * t_s;
        sum_tt += t_s * t_s;
    }
    return (count * sum_nt - sum_n * sum_t) / (count * sum_tt - sum_t * sum_t);
}

std::vector<int> missed_refreshes(std::span<const double> swap_times_s, double hz) {
    // Number each swap by its time, then bring those that were noticed late before the ones that follow.
    std::vector<int> numbers;
    for (const double time_s : swap_times_s) {
        const int by_time = static_cast<int>(std::lround((time_s - swap_times_s[0]) * hz));
        numbers.push_back(std::max(by_time, static_cast<int>(numbers.size())));
    }
    for (std::size_t i = numbers.size(); i-- > 1;) {
        numbers[i - 1] = std::min(numbers[i - 1], numbers[i] - 1);
    }
    std::vector<int> missed;
    for (std::size_t i = 1; i < numbers.size(); ++i) {
        missed.push_back(numbers[i] - numbers[i - 1] - 1);
    }
    return missed;
}

int whole_frames(double duration_s, double hz) {
    return std::max(1, static_cast<int>(std::lround(duration_s * hz)));
}

int missed_frames(double interval_s, int expected, double hz) {
    const double late = interval_s * hz - expected; // periods
    return late > late_share ? static_cast<int>(std::ceil(late - late_share)) : 0;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace experiment
