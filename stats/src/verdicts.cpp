// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "verdicts.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "labels.h"
#include "outcome.h"

namespace stats {
namespace {

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

/// A distance, an azimuth or a condition of one pair of shaders, with its outcome.
struct Place {
    std::string name;
    Outcome outcome;
    bool condition = false;
};

/// All places that have answers, but not all of the pair's: those would say the same again.
std::vector<Place> places_of(const Analysis& analysis, const GroupRow& pair) {
    std::vector<Place> places;
    for (const GroupRow& group : analysis.groups) {
        if (group.reference == pair.reference && group.test == pair.test && group.by != "all" &&
            group.figures && group.tally.n < pair.tally.n) {
            places.push_back(
                {group.by == "distance" ? distance_label(group.level) : group.level + "\u00b0 azimuth",
                 outcome_of(*group.figures)});
        }
    }
    for (const Row& row : analysis.rows) {
        const Condition& c = row.condition;
        if (c.reference == pair.reference && c.test == pair.test && row.figures &&
            row.tally.n < pair.tally.n) {
            places.push_back(
                {fmt::format("{} - {}", distance_label(c.distance), azimuth_label(c.azimuth_deg)),
                 outcome_of(*row.figures), true});
        }
    }
    return places;
}

/// The places for which a condition holds, with who is preferred there: distances and azimuths by name,
/// single conditions only where no distance or azimuth shows it. Empty where there are none.
template <typename Holds>
std::string named_places(const std::vector<Place>& places, const GroupRow& pair, Holds holds) {
    for (const bool condition : {false, true}) {
        std::vector<std::string> names;
        for (const Place& place : places) {
            if (place.condition == condition && holds(place.outcome)) {
                names.push_back(fmt::format(
                    "{} ({} preferred)", place.name,
                    shader_label(place.outcome.reference_preferred ? pair.reference : pair.test)));
            }
        }
        if (!names.empty()) {
            return listed(std::move(names));
        }
    }
    return "";
}

std::string range(const EquivalenceBounds& bounds) {
    return fmt::format("{} to {}", bounds.low, bounds.high);
}

std::string differing_headline(const GroupRow& pair, const Outcome& outcome, const std::vector<Place>& places,
                               const EquivalenceBounds& bounds) {
    const std::string test = shader_label(pair.test), reference = shader_label(pair.reference);
    std::string text = fmt::format("{} differs from {}: {} is preferred", test, reference,
                                   outcome.reference_preferred ? reference : test);
    if (outcome.within_bounds) {
        text += ", yet within the bounds of " + range(bounds);
    }
    if (!pair.figures->participant.order) {
        text += " - or the interval it stood in, as no participant answered a condition in both orders";
    }
    const std::string opposite = named_places(places, pair, [&](const Outcome& other) {
        return other.differs() && other.reference_preferred != outcome.reference_preferred;
    });
    return text + (opposite.empty() ? "" : ", but not at " + opposite);
}

/// As good holds for every distance and azimuth, or on average only.
std::string equal_headline(const GroupRow& pair, const std::vector<Place>& places,
                           const EquivalenceBounds& bounds) {
    const std::string contradicted =
        named_places(places, pair, [](const Outcome& other) { return other.differs_beyond_bounds(); });
    std::vector<std::string> unshown;
    for (const Place& place : places) {
        if (!place.condition && !place.outcome.within_bounds && !place.outcome.differs()) {
            unshown.push_back(place.name);
        }
    }
    const bool everywhere = contradicted.empty() && unshown.empty();
    std::string text = fmt::format("{}{} is as good as {} within the bounds of {}",
                                   everywhere ? "" : "On average over conditions, ", shader_label(pair.test),
                                   shader_label(pair.reference), range(bounds));
    if (!contradicted.empty()) {
        text += ", but not at " + contradicted;
    }
    if (!unshown.empty()) {
        text += "; taken alone, it is not shown at " + listed(std::move(unshown));
    }
    return text;
}

std::string open_headline(const GroupRow& pair, const Outcome& outcome, const std::vector<Place>& places,
                          std::size_t tests) {
    const bool untestable = outcome.kind == Outcome::Kind::untestable;
    std::string text =
        fmt::format("{} against {} {}: {}", shader_label(pair.test), shader_label(pair.reference),
                    untestable ? "cannot be tested" : "is undecided",
                    outcome.why.empty() ? "neither a difference nor equality is shown" : outcome.why);
    const std::size_t participants = pair.figures->participant.participants;
    if (!untestable && participants < fewest_participants(tests)) {
        text += fmt::format(" ({} cannot show a difference over {} tests; it takes {})",
                            participants_text(participants), tests, fewest_participants(tests));
    }
    const std::string differing =
        named_places(places, pair, [](const Outcome& other) { return other.differs(); });
    return text + (differing.empty() ? "" : "; they differ at " + differing);
}

std::string evidence(const GroupRow& pair, std::size_t tests) {
    const Figures& f = *pair.figures;
    const ParticipantLevel& level = f.participant;
    std::string text =
        fmt::format("{} was chosen in {:.1f} % of answers", shader_label(pair.reference), 100 * f.proportion);
    if (level.mean) {
        text += fmt::format("; mean of the {} {:.1f} % (95 % t interval {:.1f} to {:.1f} %)",
                            participants_text(level.participants), 100 * level.mean->mean,
                            100 * level.mean->ci.low, 100 * level.mean->ci.high);
    } else {
        text += fmt::format(", by {}: no interval over participants", participants_text(level.participants));
    }
    text += fmt::format(". Participants as the sample: sign-flip p {}, by Holm's method over {} of the "
                        "shaders' table p {}; equivalence {}; {}",
                        sign_flip_phrase(level.sign_flip), all_counted(tests, "row"), p_phrase(level.p_holm),
                        level.p_equivalence ? "p " + p_phrase(*level.p_equivalence) : "cannot be tested",
                        mixed_text(level.mixed));
    return text + fmt::format(". As if all answers were independent (pooled): Wilson 95 % interval {:.1f} to "
                              "{:.1f} %, chi-square p {}, equivalence p {}, {}.",
                              100 * f.ci.low, 100 * f.ci.high, p_phrase(f.chi_square.p),
                              p_phrase(f.p_equivalence), bayes_text(f.log_bf01));
}

} // namespace

std::string verdict_words(const GroupRow& group, const EquivalenceBounds& bounds) {
    if (!group.figures) {
        return "n/a";
    }
    const Outcome outcome = outcome_of(*group.figures);
    switch (outcome.kind) {
    case Outcome::Kind::differs:
        return fmt::format("differs, {} preferred{}",
                           shader_label(outcome.reference_preferred ? group.reference : group.test),
                           outcome.within_bounds ? ", but within " + range(bounds) : "");
    case Outcome::Kind::as_good:
        return "as good within " + range(bounds);
    case Outcome::Kind::untestable:
        return "cannot be tested";
    case Outcome::Kind::undecided:
        break;
    }
    return "undecided";
}

std::vector<Verdict> verdicts(const Analysis& analysis) {
    const auto tests = static_cast<std::size_t>(
        std::count_if(analysis.groups.begin(), analysis.groups.end(),
                      [](const GroupRow& group) { return group.figures.has_value(); }));
    const EquivalenceBounds& bounds = analysis.settings.bounds;
    std::vector<Verdict> result;
    for (const GroupRow* pair : overall(analysis.groups)) {
        if (!pair->figures) {
            continue;
        }
        const Outcome outcome = outcome_of(*pair->figures);
        const std::vector<Place> places = places_of(analysis, *pair);
        const std::string headline = outcome.differs() ? differing_headline(*pair, outcome, places, bounds)
                                     : outcome.kind == Outcome::Kind::as_good
                                         ? equal_headline(*pair, places, bounds)
                                         : open_headline(*pair, outcome, places, tests);
        result.push_back({headline + ".", evidence(*pair, tests)});
    }
    return result;
}

std::string order_sentence(const Analysis& analysis) {
    const OrderTally all = all_orders(analysis);
    std::string text =
        fmt::format("The first interval was chosen in {} of {} answers ({:.1f} %)", all.first_chosen(),
                    all.n(), 100 * static_cast<double>(all.first_chosen()) / static_cast<double>(all.n()));
    std::vector<Tally> participants;
    for (const ParticipantQuality& one : analysis.participants) {
        participants.push_back(one.first_interval);
    }
    SignFlipLimits limits;
    limits.seed = analysis.settings.seed;
    const auto bias = order_bias(participants, limits);
    if (!bias) {
        return text +
               ": a bias to an interval cannot be separated from a preference, as no participant answered "
               "a condition in both orders.";
    }
    text += fmt::format("; freed from preference, the mean of {} {:.1f} %",
                        participants_text(bias->participants), 100 * bias->first_share);
    if (bias->participants < fewest_participants(1)) {
        return text + fmt::format(": too few to test; it takes {}.", fewest_participants(1));
    }
    return text + fmt::format(" (sign-flip p {}): {}.", sign_flip_phrase(bias->sign_flip),
                              bias->sign_flip.p > alpha ? "no bias to either interval is shown"
                              : bias->first_share > 0.5 ? "a bias to the first interval"
                                                        : "a bias to the second interval");
}

} // namespace stats
