// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/analysis.h>

#include <support/error.h>

namespace stats {

Analysis analyse_study(const std::filesystem::path& folder, const Settings& settings,
                       const Leniency& leniency) {
    Analysis analysis;
    analysis.settings = settings;
    analysis.study = read_study(folder, leniency);
    analysis.rows = make_table(analysis.study, settings);
    analysis.groups = make_groups(analysis.study, settings);
    analysis.participants = participant_quality(analysis.study);
    try {
        analysis.expertise = compare_expertise(read_expertise(folder), analysis.participants);
    } catch (const support::InputError& error) {
        if (!leniency.skip_bad) {
            throw;
        }
        analysis.study.bad_files.push_back({"questions on expertise", error.what()});
    }
    return analysis;
}

OrderTally all_orders(const Analysis& analysis) {
    OrderTally all;
    for (const ParticipantQuality& one : analysis.participants) {
        all.reference_first.n += one.order.reference_first.n;
        all.reference_first.reference_chosen += one.order.reference_first.reference_chosen;
        all.reference_second.n += one.order.reference_second.n;
        all.reference_second.reference_chosen += one.order.reference_second.reference_chosen;
    }
    return all;
}

} // namespace stats
