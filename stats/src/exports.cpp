// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/exports.h>

#include <iterator>

#include <fmt/format.h>

#include "labels.h"

namespace stats {
namespace {

std::string seconds(const std::optional<double>& value) { return value ? exact(*value) : "n/a"; }

template <typename Use>
void for_each_trial(const Study& study, Use use) {
    for (const Run& run : study.runs) {
        for (std::size_t i = 0; run.used && i < run.log.trials.size(); ++i) {
            use(run, run.log.trials[i]);
        }
    }
}

} // namespace

std::string trials_tsv(const Study& study) {
    std::string text =
        "participant_id\trun\ttrial\treference\ttest\tdistance\tazimuth_deg\treference_first\tresponse\t"
        "reference_chosen\tfirst_chosen\tresponse_time\tonset_first\tonset_grey\tonset_second\tsimulated\n";
    for_each_trial(study, [&](const Run& run, const Trial& trial) {
        const Condition& c = trial.condition;
        const auto first = trial.first_chosen();
        fmt::format_to(std::back_inserter(text), "sub-{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t", run.participant,
                       run.number, trial.number, c.reference, c.test, c.distance, exact(c.azimuth_deg),
                       trial.reference_first ? 1 : 0);
        text +=
            first ? fmt::format("{}\t{}\t{}", *first ? 1 : 2, *trial.reference_chosen ? 1 : 0, *first ? 1 : 0)
                  : "n/a\tn/a\tn/a";
        fmt::format_to(std::back_inserter(text), "\t{}\t{}\t{}\t{}\t{}\n", seconds(trial.response_time_s),
                       seconds(trial.onset_first_s), seconds(trial.onset_grey_s),
                       seconds(trial.onset_second_s), run.sidecar.simulated || study.simulated);
    });
    return text;
}

std::string comparisons_csv(const Study& study) {
    std::string text = "observer,session,scene,condition_A,condition_B,is_A_selected\n";
    for_each_trial(study, [&](const Run& run, const Trial& trial) {
        const Condition& c = trial.condition;
        if (trial.reference_chosen) {
            fmt::format_to(std::back_inserter(text), "sub-{},{},{}_{},{},{},{}\n", run.participant,
                           run.number, c.distance, exact(c.azimuth_deg), c.reference, c.test,
                           *trial.reference_chosen ? 1 : 0);
        }
    });
    return text;
}

} // namespace stats
