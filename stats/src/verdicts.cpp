// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "verdicts.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "labels.h"

namespace stats {
namespace {

bool disagrees(const Figures& figures) {
    return (figures.chi_square.p <= alpha) != (figures.participant.sign_flip.p <= alpha);
}

/// Equivalence over participants where that can be tested, else over answers.
bool equivalent(const Figures& figures) {
    return figures.participant.p_equivalence.value_or(figures.p_equivalence) <= alpha;
}

std::string mixed_text(const std::optional<MixedModel>& model) {
    return model ? fmt::format("mixed model p {}", p_phrase(model->p)) : "no mixed model can be estimated";
}

/// How many times as probable the answers are under the likelier of the two hypotheses.
std::string bayes_text(double log_bf01) {
    const double factor = std::exp(std::abs(log_bf01));
    const std::string times = factor >= 1e4   ? "over 10,000"
                              : factor >= 100 ? fmt::format("{:.0f}", factor)
                                              : fmt::format("{:.3g}", factor);
    return fmt::format("Bayes factor {} for {}", times, log_bf01 >= 0 ? "no preference" : "a preference");
}

} // namespace

std::vector<std::string> disagreements(const Analysis& analysis) {
    std::vector<std::string> sentences;
    const auto shaders = overall(analysis.groups);
    for (const GroupRow* group : shaders) {
        if (!group->figures || !disagrees(*group->figures)) {
            continue;
        }
        const ParticipantLevel& level = group->figures->participant;
        sentences.push_back(fmt::format(
            "Pooled and participant-level tests disagree on {} against {} over all conditions: with all "
            "answers as if independent p {}, with the {} participants as the sample p {} ({}sign-flip; {}). "
            "Answers of one participant are not independent: rely on the participant-level test.",
            shader_label(group->test), shader_label(group->reference), p_phrase(group->figures->chi_square.p),
            level.participants, p_phrase(level.sign_flip.p), level.sign_flip.exact ? "exact " : "",
            mixed_text(level.mixed)));
    }
    if (sentences.empty() && !shaders.empty()) {
        sentences.push_back("Pooled and participant-level tests agree on every shader over all conditions.");
    }

    // Single conditions have few answers a participant, so that their participant-level tests find less.
    std::vector<std::string> places;
    for (const Row& row : analysis.rows) {
        if (row.figures && disagrees(*row.figures)) {
            places.push_back(fmt::format(
                "{} at {} - {} (pooled p {}, sign-flip p {})", shader_label(row.condition.test),
                distance_label(row.condition.distance), azimuth_label(row.condition.azimuth_deg),
                p_phrase(row.figures->chi_square.p), p_phrase(row.figures->participant.sign_flip.p)));
        }
    }
    if (!places.empty()) {
        sentences.push_back(fmt::format("In {} of {} single conditions they disagree: {}.", places.size(),
                                        analysis.rows.size(), listed(places)));
    }
    return sentences;
}

bool any_shader_disagrees(const Analysis& analysis) {
    const auto shaders = overall(analysis.groups);
    return std::any_of(shaders.begin(), shaders.end(),
                       [](const GroupRow* group) { return group->figures && disagrees(*group->figures); });
}

std::string verdict_words(const Figures& figures, const EquivalenceBounds& bounds) {
    const bool differs = figures.participant.sign_flip.p <= alpha, same = equivalent(figures);
    const std::string range = fmt::format("{} to {}", bounds.low, bounds.high);
    if (differs) {
        return same ? "differs, but within " + range : "differs";
    }
    return same ? "as good within " + range : "undecided";
}

std::vector<Verdict> verdicts(const Analysis& analysis) {
    std::vector<Verdict> result;
    const EquivalenceBounds& bounds = analysis.settings.bounds;
    for (const GroupRow* group : overall(analysis.groups)) {
        if (!group->figures) {
            continue;
        }
        const Figures& f = *group->figures;
        const ParticipantLevel& level = f.participant;
        const bool differs = level.sign_flip.p <= alpha, same = equivalent(f);
        const std::string test = shader_label(group->test), reference = shader_label(group->reference);
        std::string headline =
            differs ? fmt::format("{} differs from {}", test, reference)
            : same  ? fmt::format("{} is as good as {}", test, reference)
                    : fmt::format("{} against {} is undecided: neither a difference nor equality "
                                   "is shown",
                                  test, reference);
        if (same) {
            headline += fmt::format("{} within the bounds of {} to {}", differs ? ", yet" : "", bounds.low,
                                    bounds.high);
        }
        std::string evidence = fmt::format(
            "{} was chosen in {:.1f} % of answers (95 % interval {:.1f} to {:.1f} %). Participants as the "
            "sample: sign-flip p {}, {}",
            reference, 100 * f.proportion, 100 * f.ci.low, 100 * f.ci.high, p_phrase(level.sign_flip.p),
            mixed_text(level.mixed));
        if (level.p_equivalence) {
            evidence += fmt::format(", equivalence p {}", p_phrase(*level.p_equivalence));
        }
        evidence += fmt::format(". Answers as the sample: chi-square p {}, equivalence p {}, {}.",
                                p_phrase(f.chi_square.p), p_phrase(f.p_equivalence), bayes_text(f.log_bf01));
        result.push_back({headline + ".", evidence});
    }
    return result;
}

std::string order_sentence(const Analysis& analysis) {
    const OrderTally all = all_orders(analysis);
    const double p = binomial_two_sided_p(all.first_chosen(), all.n());
    return fmt::format(
        "The first interval was chosen in {} of {} answers ({:.1f} %; exact p {}): {}.", all.first_chosen(),
        all.n(), 100 * static_cast<double>(all.first_chosen()) / static_cast<double>(all.n()), p_phrase(p),
        p > alpha                          ? "no bias to either interval is shown"
        : 2 * all.first_chosen() > all.n() ? "a bias to the first interval"
                                           : "a bias to the second interval");
}

} // namespace stats
