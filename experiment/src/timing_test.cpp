// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "timing_test.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <study/protocol.h>
#include <support/error.h>

#include "interruption.h"
#include "window/pacing.h"
#include "window/window_stage.h"

namespace experiment {
namespace {

// The best laboratory programs on Linux are exact to a fifth of a millisecond at a picture's onset
// [Bridges2020]; these bounds leave room, and stay far below a frame.
constexpr double picture_s = 0.25; // that a picture stays between two greys
constexpr double acceptable_median_s = 1e-3, acceptable_worst_s = 2e-3;

double worst(const std::vector<double>& values) {
    return std::abs(*std::max_element(values.begin(), values.end(),
                                      [](double a, double b) { return std::abs(a) < std::abs(b); }));
}

double median_size(std::vector<double> values) {
    std::transform(values.begin(), values.end(), values.begin(),
                   [](double value) { return std::abs(value); });
    return median(values);
}

double standard_deviation(const std::vector<double>& values) {
    const auto count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    const double squares = std::accumulate(values.begin(), values.end(), 0.0, [&](double sum, double value) {
        return sum + (value - mean) * (value - mean);
    });
    return values.size() < 2 ? 0 : std::sqrt(squares / (count - 1));
}

bool acceptable(const std::vector<double>& grey_error_s, int dropped_frames) {
    return median_size(grey_error_s) < acceptable_median_s && worst(grey_error_s) < acceptable_worst_s &&
           dropped_frames == 0;
}

bool acceptable(const TimingFindings& findings) {
    return acceptable(findings.grey_error_s, findings.dropped_frames);
}

/// How long a grey can be shown for that is asked for: where swaps wait for the refresh, a whole number of
/// frames.
double showable_s(double grey_s, const std::optional<double>& vsync_hz) {
    return vsync_hz ? whole_frames(grey_s, *vsync_hz) / *vsync_hz : grey_s;
}

/// A picture whose neighbouring pixels differ, so that no driver can make it cheap.
Pixels test_picture(int width, int height, int shift) {
    Pixels picture{width, height, {}};
    const auto count = 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    for (std::size_t i = 0; i < count; ++i) {
        picture.rgba.push_back(static_cast<std::uint8_t>(37 * i + 101 * static_cast<std::size_t>(shift)));
    }
    return picture;
}

/// The protocol's screens or, without one, those of the published study as far as the monitor has room for
/// them.
study::Protocol protocol_of(const SessionOptions& options) {
    if (!options.protocol.empty()) {
        return study::read_protocol(options.protocol);
    }
    study::Protocol protocol;
    protocol.session.leave = {.ctrl = true, .shift = true, .key = 'q'};
    const Glfw glfw;
    const auto [width, height] = resolution_of(options.screen.monitor);
    protocol.image.width = std::min(protocol.image.width, width);
    protocol.image.height = std::min(protocol.image.height, height);
    return protocol;
}

TimingFindings measure(const study::Protocol& protocol, const ScreenOptions& screen, double seconds) {
    const std::array<Stimulus, 2> pictures{Stimulus{"test", "one", 0}, Stimulus{"test", "two", 0}};
    WindowStage stage(protocol,
                      {{pictures[0], test_picture(protocol.image.width, protocol.image.height, 0)},
                       {pictures[1], test_picture(protocol.image.width, protocol.image.height, 1)}},
                      screen);
    TimingFindings findings;
    findings.grey_s = protocol.session.grey_s;
    const double start_s = stage.show(pictures[0]);
    for (std::size_t i = 0; i == 0 || stage.now_s() < start_s + seconds; ++i) {
        const double onset_grey_s = stage.show_after(picture_s, Grey{protocol.session.grey_level});
        const double onset_s = stage.show_after(findings.grey_s, pictures[i % 2]);
        findings.grey_error_s.push_back(onset_s - onset_grey_s -
                                        showable_s(findings.grey_s, stage.facts().refresh_hz));
    }
    for (const Flip& flip : stage.flips()) {
        findings.swap_s.push_back(flip.onset_s - flip.called_s);
        findings.dropped_frames += flip.missed_frames;
    }
    findings.monitor = stage.facts().monitor;
    findings.pacing = stage.facts().pacing;
    findings.refresh_hz = stage.refresh().hz;
    findings.refresh_sd_s = stage.refresh().sd_s;
    return findings;
}

} // namespace

std::string timing_report(const TimingFindings& findings) {
    constexpr double ms = 1000;
    const bool vsync = findings.pacing == "vsync";
    std::string report =
        fmt::format("Timing on monitor {}\n\n"
                    "  swaps             {:.2f} a second, SD of their intervals {:.3f} ms\n"
                    "  pacing            {}\n"
                    "  grey, asked for   {:.3f} s, {} times\n"
                    "  grey, error       median {:.3f} ms, worst {:.3f} ms, SD {:.3f} ms\n"
                    "  swap              median {:.3f} ms, worst {:.3f} ms\n"
                    "  dropped frames    {}\n\n",
                    findings.monitor, findings.refresh_hz, ms * findings.refresh_sd_s, findings.pacing,
                    findings.grey_s, findings.grey_error_s.size(), ms * median_size(findings.grey_error_s),
                    ms * worst(findings.grey_error_s), ms * standard_deviation(findings.grey_error_s),
                    ms * median(findings.swap_s), ms * worst(findings.swap_s),
                    vsync ? std::to_string(findings.dropped_frames) : "n/a, no refresh to count by");
    report += "How to read it\n"
              "  Each time is taken when a swap of the buffers is over. With pacing \"vsync\" that is when "
              "the display\n"
              "  begins to show a picture, and the grey lasts a whole number of frames; with \"clock\" it is "
              "when the\n"
              "  picture was handed to the display server, and the display may show it up to a frame later.\n"
              "  The error is what the grey lasted beyond the time asked for; a display's own delay, some "
              "milliseconds\n"
              "  the same for all pictures, is not in it: only a photodiode on the screen measures that.\n\n";
    report += fmt::format(
        "Acceptable are a median error below {:.0f} ms, a worst one below {:.0f} ms, and no dropped "
        "frame.\nThis machine: {}.\n",
        ms * acceptable_median_s, ms * acceptable_worst_s,
        acceptable(findings) ? "acceptable" : "not acceptable");
    if (!acceptable(findings)) {
        report += "Close other programs, turn off the desktop's compositor and power saving, use the full "
                  "screen, and "
                  "test again.\n";
    } else if (!vsync) {
        report +=
            "A display whose swaps wait for its refresh would be better still: turn on vertical sync in the "
            "driver.\n";
    }
    return report;
}

void tell_timing(const StageFacts& facts, double grey_s, const Timing& timing) {
    constexpr double ms = 1000;
    if (facts.observer || timing.grey_error_s.empty()) {
        return;
    }
    // The sidecar holds errors of what was asked for.
    std::vector<double> grey_error_s = timing.grey_error_s;
    for (double& error_s : grey_error_s) {
        error_s += grey_s - showable_s(grey_s, facts.refresh_hz);
    }
    fmt::print("the grey was off by {:.2f} ms (median), {:.2f} ms (worst); dropped frames: {}\n",
               ms * median_size(grey_error_s), ms * worst(grey_error_s),
               facts.dropped_frames ? std::to_string(*facts.dropped_frames) : "n/a");
    if (!acceptable(grey_error_s, facts.dropped_frames.value_or(0))) {
        fmt::print(
            stderr,
            "skin2afc: warning: the timing was not acceptable throughout; the sidecar has each trial's, "
            "and --timing-test tests the display\n");
    }
}

void run_timing_test(const SessionOptions& options, double seconds) {
    const Interruption interruption;
    const TimingFindings findings = measure(protocol_of(options), options.screen, seconds);
    fmt::print("{}", timing_report(findings));
    if (!acceptable(findings)) {
        throw support::Failure("the timing of this display is not acceptable, see the report");
    }
}

} // namespace experiment
