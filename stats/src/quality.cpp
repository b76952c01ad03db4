// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/quality.h>

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include <stats/proportion.h>
#include <stats/two_groups.h>

#include "labels.h"
#include "order_strata.h"

namespace stats {
namespace {

ParticipantQuality quality_of(const Run& run) {
    ParticipantQuality result;
    result.participant = run.participant;
    result.file = run.file;
    result.complete = run.complete;
    result.trials = run.log.trials.size();
    result.dropped_frames = run.sidecar.dropped_frames;
    std::vector<double> times_s;
    OrderStrata strata;
    for (const Trial& trial : run.log.trials) {
        if (!trial.reference_chosen) {
            ++result.missing;
            continue;
        }
        Tally& tally = trial.reference_first ? result.order.reference_first : result.order.reference_second;
        ++tally.n;
        strata.add(trial);
        tally.reference_chosen += *trial.reference_chosen ? 1 : 0;
        result.errors += *trial.reference_chosen ? 0 : 1;
        if (trial.response_time_s) {
            times_s.push_back(*trial.response_time_s);
            result.fast += *trial.response_time_s < fast_answer_s ? 1 : 0;
        }
    }
    std::sort(times_s.begin(), times_s.end());
    result.median_response_time_s = quantile(times_s, 0.5);
    result.both_orders = in_both_orders(strata.tallies());
    result.first_interval = first_interval(strata.tallies());
    result.p_order = order_p(result.both_orders);
    result.p_first = binomial_two_sided_p(result.order.first_chosen(), result.order.n());
    return result;
}

/// "sub-01 (2 of 72)" for each participant with a count.
template <typename Count>
std::vector<std::string> counted(std::span<const ParticipantQuality> participants, Count count) {
    std::vector<std::string> items;
    for (const ParticipantQuality& one : participants) {
        if (const std::size_t n = count(one); n > 0) {
            items.push_back(fmt::format("sub-{} ({} of {})", one.participant, n, one.trials));
        }
    }
    return items;
}

void add_counts(std::vector<std::string>& notes, std::vector<std::string> items, std::string_view what) {
    if (!items.empty()) {
        notes.push_back(fmt::format("{}: {}.", what, listed(std::move(items))));
    }
}

/// What a run that counts has that its protocol would not give: fewer trials or more, gaps in their numbers,
/// answers that took longer than any session.
void add_irregular_runs(std::vector<std::string>& notes, const Study& study) {
    constexpr double longest_s = 3600;
    std::vector<std::string> short_of, extra, gaps, slow;
    for (const Run& run : study.runs) {
        const auto& trials = run.log.trials;
        if (!run.used || trials.empty()) {
            continue;
        }
        if (!run.complete) {
            short_of.push_back(fmt::format("sub-{} counts with {} of {} trials", run.participant,
                                           trials.size(), run.trials_expected));
        }
        if (trials.size() > run.trials_expected) {
            extra.push_back(
                fmt::format("sub-{} ({}, not {})", run.participant, trials.size(), run.trials_expected));
        }
        const auto last = std::max_element(
            trials.begin(), trials.end(), [](const Trial& a, const Trial& b) { return a.number < b.number; });
        if (last->number > static_cast<std::int64_t>(trials.size())) {
            gaps.push_back(fmt::format("sub-{} ({} trials, the last number {})", run.participant,
                                       trials.size(), last->number));
        }
        const auto slow_ones = std::count_if(trials.begin(), trials.end(), [](const Trial& trial) {
            return trial.response_time_s.value_or(0) > longest_s;
        });
        if (slow_ones > 0) {
            slow.push_back(fmt::format("sub-{} ({} of {})", run.participant, slow_ones, trials.size()));
        }
    }
    add_counts(notes, std::move(short_of), "Incomplete runs");
    add_counts(notes, std::move(extra), "More trials than planned, kept");
    add_counts(notes, std::move(gaps), "Numbers of trials are missing");
    add_counts(notes, std::move(slow), "Answers after more than an hour, kept");
}

} // namespace

bool ParticipantQuality::always_same_interval() const {
    constexpr std::int64_t enough = 10; // 1 in 500 by chance
    const std::int64_t first = order.first_chosen(), n = order.n();
    return both_orders.n() >= enough && (first == 0 || first == n);
}

bool ParticipantQuality::favours_interval() const {
    constexpr double lopsided = 0.001;
    return !always_same_interval() && p_order < lopsided;
}

std::vector<ParticipantQuality> participant_quality(const Study& study) {
    std::vector<ParticipantQuality> result;
    for (const Run& run : study.runs) {
        if (run.used) {
            result.push_back(quality_of(run));
        }
    }
    return result;
}

std::vector<std::string> quality_notes(const Study& study, std::span<const ParticipantQuality> participants) {
    std::vector<std::string> notes;
    add_counts(notes, counted(participants, [](const auto& p) { return p.missing; }),
               "Trials without an answer, left out");
    const bool timed = std::any_of(participants.begin(), participants.end(),
                                   [](const auto& one) { return !std::isnan(one.median_response_time_s); });
    if (!timed) {
        notes.push_back("Response times are not recorded: answers under 300 ms cannot be told.");
    }
    add_counts(notes, counted(participants, [](const auto& p) { return p.fast; }),
               fmt::format("Answers within {:.0f} ms of the second picture, kept", 1000 * fast_answer_s));
    std::vector<std::string> always, favours;
    std::int64_t dropped = 0;
    std::size_t runs_dropping = 0;
    for (const ParticipantQuality& one : participants) {
        const std::string name = fmt::format("sub-{} (first in {} of {})", one.participant,
                                             one.order.first_chosen(), one.order.n());
        if (one.always_same_interval()) {
            always.push_back(name);
        } else if (one.favours_interval()) {
            favours.push_back(name);
        }
        dropped += one.dropped_frames.value_or(0);
        runs_dropping += one.dropped_frames.value_or(0) > 0 ? 1 : 0;
    }
    add_counts(notes, std::move(always), "Always chose the same interval, kept");
    add_counts(notes, std::move(favours), "Favour one interval, whatever it showed (p < 0.001), kept");
    if (dropped > 0) {
        notes.push_back(fmt::format("Dropped frames: {} in {} run{}.", dropped, runs_dropping,
                                    runs_dropping == 1 ? "" : "s"));
    }
    add_irregular_runs(notes, study);
    std::set<std::string> stimuli;
    for (const Run& run : study.runs) {
        if (run.used && !run.sidecar.stimuli.empty()) {
            stimuli.insert(run.sidecar.stimuli);
        }
    }
    if (stimuli.size() > 1) {
        notes.push_back(fmt::format(
            "Runs with {} different sets of stimuli are taken together; where pictures are shown, "
            "they are those of most runs.",
            stimuli.size()));
    }
    if (study.protocols > 1) {
        notes.push_back(
            fmt::format("Runs of {} different protocol files are taken together.", study.protocols));
    }
    return notes;
}

std::string to_tsv(std::span<const ParticipantQuality> participants, bool simulated) {
    std::string text = "participant_id\tfile\tcomplete\ttrials\tmissing\tunder_300_ms\terrors\tfirst_chosen\t"
                       "p_first\tflag\trt_median\tdropped_frames\tsimulated\tp_order\n";
    for (const ParticipantQuality& one : participants) {
        const std::string_view flag = one.always_same_interval() ? "always_same_interval"
                                      : one.favours_interval()   ? "favours_interval"
                                                                 : "n/a";
        text +=
            fmt::format("sub-{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", one.participant,
                        one.file, one.complete, one.trials, one.missing, one.fast, one.errors,
                        one.order.first_chosen(), exact(one.p_first), flag, exact(one.median_response_time_s),
                        one.dropped_frames ? fmt::format("{}", *one.dropped_frames) : "n/a", simulated,
                        one.both_orders.n() > 0 ? exact(one.p_order) : "n/a");
    }
    return text;
}

} // namespace stats
