// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>

#include <fmt/format.h>

#include "labels.h"
#include "outcome.h"
#include "verdicts.h"

namespace stats {
namespace {

bool on_difference(const Figures& figures) {
    return (figures.chi_square.p <= alpha) != (figures.participant.sign_flip.p <= alpha);
}

bool on_equivalence(const Figures& figures) {
    const auto& p = figures.participant.p_equivalence;
    return (figures.p_equivalence <= alpha) != (p && *p <= alpha);
}

bool disagrees(const Figures& figures) { return on_difference(figures) || on_equivalence(figures); }

/// "difference: pooled p = 0.001, sign-flip p = 0.200" for what they disagree on.
std::string numbers(const Figures& figures) {
    const ParticipantLevel& level = figures.participant;
    std::string text;
    if (on_difference(figures)) {
        text = fmt::format("difference: pooled p {}, sign-flip p {}", p_phrase(figures.chi_square.p),
                           sign_flip_phrase(level.sign_flip));
    }
    if (on_equivalence(figures)) {
        text += fmt::format("{}equivalence: pooled p {}, over participants {}", text.empty() ? "" : "; ",
                            p_phrase(figures.p_equivalence),
                            level.p_equivalence ? "p " + p_phrase(*level.p_equivalence) : "not testable");
    }
    return text;
}

/// One sentence on the rows of a kind that disagree; none where there are none.
void add_places(std::vector<std::string>& sentences, std::vector<std::string> places, std::size_t rows,
                std::string_view kind) {
    if (!places.empty()) {
        const std::size_t count = places.size();
        sentences.push_back(
            fmt::format("In {} of {} {} they disagree: {}.", count, rows, kind, listed(std::move(places))));
    }
}

/// What is said where no shader shows them to disagree: that they agree, as far as both can be tested.
std::string agreement(const std::vector<const GroupRow*>& pairs) {
    std::vector<std::string> too_few, no_spread;
    std::size_t testable = 0;
    for (const GroupRow* pair : pairs) {
        const ParticipantLevel& level = pair->figures->participant;
        if (level.participants < fewest_participants(1)) {
            too_few.push_back(
                fmt::format("{} ({})", shader_label(pair->test), participants_text(level.participants)));
            continue;
        }
        ++testable;
        if (!level.p_equivalence) {
            no_spread.push_back(shader_label(pair->test));
        }
    }
    if (testable == 0) {
        return fmt::format(
            "Whether pooled and participant-level tests agree cannot be told: no sign-flip test "
            "can be significant below {}.",
            participants_text(fewest_participants(1)));
    }
    std::string text = fmt::format("Pooled and participant-level tests agree on {} over all conditions, on "
                                   "difference{} (p uncorrected)",
                                   too_few.empty() ? "every shader" : "every shader that can be tested",
                                   no_spread.size() == testable ? "" : " and on equivalence");
    if (!no_spread.empty()) {
        text += fmt::format(
            "; equivalence cannot be tested for {}, where all participants have the same proportion",
            listed(std::move(no_spread)));
    }
    if (!too_few.empty()) {
        text += fmt::format("; too few participants to test {}", listed(std::move(too_few)));
    }
    return text + ".";
}

} // namespace

std::vector<std::string> disagreements(const Analysis& analysis) {
    std::vector<std::string> sentences, groups, conditions;
    std::vector<const GroupRow*> pairs;
    std::size_t group_count = 0;
    for (const GroupRow& group : analysis.groups) {
        if (group.by != "all") {
            ++group_count;
        } else if (group.figures) {
            pairs.push_back(&group);
        }
        if (!group.figures || !disagrees(*group.figures)) {
            continue;
        }
        const std::string pair =
            fmt::format("{} against {}", shader_label(group.test), shader_label(group.reference));
        const std::size_t participants = group.figures->participant.participants;
        if (group.by == "all") {
            sentences.push_back(fmt::format(
                "Pooled and participant-level tests disagree on {} over all conditions, with {} as the "
                "sample ({}). Answers of one participant are not independent: {}.",
                pair, participants_text(participants), numbers(*group.figures),
                participants < fewest_participants(1)
                    ? "the pooled result does not hold for other participants"
                    : "rely on the participant-level tests"));
        } else {
            groups.push_back(fmt::format("{} at {} ({})", shader_label(group.test),
                                         group.by == "distance" ? distance_label(group.level)
                                                                : group.level + "\u00b0 azimuth",
                                         numbers(*group.figures)));
        }
    }
    if (sentences.empty() && !pairs.empty()) {
        sentences.push_back(agreement(pairs));
    }
    // Single conditions have few answers a participant, so that their participant-level tests find less.
    for (const Row& row : analysis.rows) {
        if (row.figures && disagrees(*row.figures)) {
            conditions.push_back(fmt::format("{} at {} - {} ({})", shader_label(row.condition.test),
                                             distance_label(row.condition.distance),
                                             azimuth_label(row.condition.azimuth_deg),
                                             numbers(*row.figures)));
        }
    }
    add_places(sentences, std::move(groups), group_count, "rows by distance and azimuth");
    add_places(sentences, std::move(conditions), analysis.rows.size(), "single conditions");
    return sentences;
}

bool any_shader_disagrees(const Analysis& analysis) {
    const auto shaders = overall(analysis.groups);
    return std::any_of(shaders.begin(), shaders.end(),
                       [](const GroupRow* group) { return group->figures && disagrees(*group->figures); });
}

} // namespace stats
