// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "findings.h"

#include <algorithm>

#include <fmt/format.h>

#include "labels.h"
#include "outcome.h"

namespace stats {
namespace {

std::string place(const Row& row) {
    return fmt::format("{} - {}", distance_label(row.condition.distance),
                       azimuth_label(row.condition.azimuth_deg));
}

std::string place_with_p(const Row* row) {
    return fmt::format("{} (p {})", place(*row), p_phrase(row->figures->chi_square.p));
}

/// The tested conditions of one pair of shaders.
struct Pair {
    std::string reference, test;
    Tally all;
    std::vector<const Row*> different, alike;
    std::size_t test_preferred = 0; ///< of the different ones

    Pair(std::span<const Row> rows, const std::string& reference_shader, const std::string& test_shader)
        : reference(shader_label(reference_shader)), test(shader_label(test_shader)) {
        for (const Row& row : rows) {
            if (row.condition.reference != reference_shader || row.condition.test != test_shader ||
                !row.figures) {
                continue;
            }
            all.n += row.tally.n;
            all.reference_chosen += row.tally.reference_chosen;
            (significant(row) ? different : alike).push_back(&row);
            test_preferred += significant(row) && row.figures->proportion < 0.5 ? 1 : 0;
        }
    }
    std::size_t tested() const { return different.size() + alike.size(); }
};

template <typename Describe>
std::string listed_rows(const std::vector<const Row*>& rows, Describe describe) {
    std::vector<std::string> items;
    std::transform(rows.begin(), rows.end(), std::back_inserter(items), describe);
    return listed(std::move(items));
}

std::string sentence(const Pair& pair) {
    const std::size_t tested = pair.tested(), different = pair.different.size();
    std::string text = "As the paper tests, ";
    if (different == 0) {
        text += fmt::format(
            "{} shows no significant difference from {} in {} (pooled p > {})", pair.test, pair.reference,
            tested == 1 ? "the only condition" : fmt::format("any of the {} conditions", tested), alpha);
    } else if (pair.alike.empty()) {
        text +=
            fmt::format("{} differs from {} in {} (pooled p \u2264 {})", pair.test, pair.reference,
                        tested == 1 ? "the only condition" : fmt::format("all {} conditions", tested), alpha);
    } else if (2 * different <= tested) {
        text += fmt::format(
            "{} shows no significant difference from {} in {} of {} conditions (pooled p > {}); it differs "
            "in {}",
            pair.test, pair.reference, pair.alike.size(), tested, alpha,
            listed_rows(pair.different, place_with_p));
    } else {
        text += fmt::format("{} differs from {} in {} of {} conditions (pooled p \u2264 {}), but not in {}",
                            pair.test, pair.reference, different, tested, alpha,
                            listed_rows(pair.alike, place_with_p));
    }
    if (different > 0 && pair.test_preferred == different) {
        text += fmt::format("; {} was the one preferred there", pair.test);
    } else if (pair.test_preferred > 0) {
        text += fmt::format("; in {} of the conditions that differ, {} was the one preferred",
                            pair.test_preferred, pair.test);
    }
    return text + fmt::format(". {} was chosen in {} of {} answers ({:.1f} %).", pair.reference,
                              pair.all.reference_chosen, pair.all.n,
                              100 * static_cast<double>(pair.all.reference_chosen) /
                                  static_cast<double>(pair.all.n));
}

std::string sentence_on_corrections(std::span<const Row> rows, const Significance& found) {
    std::string text =
        fmt::format("{} pooled tests at the {} level would give {:.2g} false alarms on average if no shader "
                    "differed. ",
                    found.tests, alpha, alpha * static_cast<double>(found.tests));
    if (found.raw == 0) {
        return text + "None is significant here.";
    }
    text += fmt::format(
        "Significant by the pooled test: {} uncorrected, {} after Holm's correction, {} after Benjamini and "
        "Hochberg's",
        found.raw, found.holm, found.bh);

    // Name the differences that stand without a correction only.
    std::vector<const Row*> lost;
    for (const Row& row : rows) {
        if (significant(row) && !significant_after_holm(row)) {
            lost.push_back(&row);
        }
    }
    if (!lost.empty()) {
        const auto describe = [](const Row* row) {
            return fmt::format("{} against {} at {} (Holm {:.3f}, Benjamini and Hochberg {:.3f})",
                               shader_label(row->condition.test), shader_label(row->condition.reference),
                               place(*row), row->figures->p_holm, row->figures->q_bh);
        };
        text += fmt::format(". Not significant after Holm's: {}", listed_rows(lost, describe));
    }
    return text + ".";
}

/// One pair of shaders with the participants as the sample, by Holm's method.
std::string participant_sentence(std::span<const Row> rows, const std::string& reference_shader,
                                 const std::string& test_shader) {
    const std::string reference = shader_label(reference_shader), test = shader_label(test_shader);
    std::vector<std::string> differing;
    std::size_t tested = 0, untestable = 0, reference_preferred = 0;
    for (const Row& row : rows) {
        if (row.condition.reference != reference_shader || row.condition.test != test_shader ||
            !row.figures) {
            continue;
        }
        const Outcome outcome = outcome_of(*row.figures);
        ++(outcome.kind == Outcome::Kind::untestable ? untestable : tested);
        if (outcome.differs()) {
            reference_preferred += outcome.reference_preferred ? 1 : 0;
            differing.push_back(fmt::format("{} ({} preferred, p {})", place(row),
                                            outcome.reference_preferred ? reference : test,
                                            p_phrase(row.figures->participant.p_holm)));
        }
    }
    const std::string too_few = fmt::format("fewer than {}", participants_text(fewest_participants(1)));
    if (tested == 0) {
        return untestable == 0 ? ""
                               : fmt::format("{} against {} cannot be tested in any condition: {}", test,
                                             reference, too_few);
    }
    const std::size_t count = differing.size();
    const std::string start = fmt::format(
        "{} differs from {} in {} of {} condition{}{}", test, reference, count, tested,
        tested == 1 ? "" : "s",
        untestable == 0 ? "" : fmt::format(" ({} more cannot be tested: {})", untestable, too_few));
    if (count > 0 && count == tested && (reference_preferred == 0 || reference_preferred == count)) {
        return fmt::format("{}, {} preferred", start, reference_preferred == 0 ? test : reference);
    }
    return start + (count == 0 ? "" : ": " + listed(std::move(differing)));
}

} // namespace

std::vector<std::string> participant_findings(std::span<const Row> rows) {
    const std::size_t tests = significance(rows).tests;
    std::size_t participants = 0;
    for (const Row& row : rows) {
        participants = std::max(participants, row.figures ? row.figures->participant.participants : 0);
    }
    if (participants < fewest_participants(tests)) {
        return {fmt::format(
            "With participants as the sample, no single condition can be tested: over {} test{}, "
            "{} cannot reach significance by Holm's method; it takes {}.",
            tests, tests == 1 ? "" : "s", participants_text(participants), fewest_participants(tests))};
    }
    std::vector<std::string> sentences;
    for (const std::string& reference : references_of(rows)) {
        for (const std::string& test : tests_of(rows)) {
            if (const std::string text = participant_sentence(rows, reference, test); !text.empty()) {
                sentences.push_back(
                    fmt::format("With participants as the sample (sign-flip test, Holm's method "
                                "over {} condition{}), {}.",
                                tests, tests == 1 ? "" : "s", text));
            }
        }
    }
    return sentences;
}

Significance significance(std::span<const Row> rows) {
    const auto count = [&](auto condition) {
        return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), condition));
    };
    return {count([](const Row& row) { return row.figures.has_value(); }), count(significant),
            count(significant_after_holm), count(significant_after_bh)};
}

std::vector<std::string> findings(std::span<const Row> rows) {
    std::vector<std::string> sentences;
    for (const std::string& reference : references_of(rows)) {
        for (const std::string& test : tests_of(rows)) {
            const Pair pair(rows, reference, test);
            if (pair.tested() > 0) {
                sentences.push_back(sentence(pair));
            }
        }
    }
    const Significance found = significance(rows);
    if (found.tests > 1) {
        sentences.push_back(sentence_on_corrections(rows, found));
    }
    return sentences;
}

std::string simulated_notice(const Study& study) {
    const Contents found = contents(study);
    if (!is_simulated(study)) {
        return "";
    }
    return found.simulated_runs == found.runs
               ? "SIMULATED DATA: no person gave these answers."
               : fmt::format("SIMULATED DATA: {} of the {} runs {} simulated.", found.simulated_runs,
                             found.runs, found.simulated_runs == 1 ? "is" : "are");
}

} // namespace stats
