// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "findings.h"

#include <algorithm>

#include <fmt/format.h>

#include "labels.h"

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
    std::string text;
    if (different == 0) {
        text = fmt::format(
            "{} shows no significant difference from {} in {} (p > {})", pair.test, pair.reference,
            tested == 1 ? "the only condition" : fmt::format("any of the {} conditions", tested), alpha);
    } else if (pair.alike.empty()) {
        text =
            fmt::format("{} differs from {} in {} (p \u2264 {})", pair.test, pair.reference,
                        tested == 1 ? "the only condition" : fmt::format("all {} conditions", tested), alpha);
    } else if (2 * different <= tested) {
        text = fmt::format(
            "{} shows no significant difference from {} in {} of {} conditions (p > {}); it differs "
            "in {}",
            pair.test, pair.reference, pair.alike.size(), tested, alpha,
            listed_rows(pair.different, place_with_p));
    } else {
        text =
            fmt::format("{} differs from {} in {} of {} conditions (p \u2264 {}), but not in {}", pair.test,
                        pair.reference, different, tested, alpha, listed_rows(pair.alike, place_with_p));
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
        fmt::format("{} tests at the {} level would give {:.2g} false alarms on average if no shader "
                    "differed. ",
                    found.tests, alpha, alpha * static_cast<double>(found.tests));
    if (found.raw == 0) {
        return text + "None is significant here.";
    }
    text += fmt::format(
        "Significant differences: {} uncorrected, {} after Holm's correction, {} after Benjamini and "
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

} // namespace

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
               : fmt::format("SIMULATED DATA: {} of the {} runs are simulated.", found.simulated_runs,
                             found.runs);
}

} // namespace stats
