// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/figures.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <stats/multiplicity.h>
#include <stats/two_groups.h>

#include "labels.h"

namespace stats {
namespace {

ResponseTimes response_times(std::vector<double> seconds) {
    std::sort(seconds.begin(), seconds.end());
    return {quantile(seconds, 0.25), quantile(seconds, 0.5), quantile(seconds, 0.75)};
}

ParticipantLevel participant_level(const Answers& answers, const Settings& settings) {
    const std::vector<Tally>& participants = answers.participants;
    ParticipantLevel level;
    level.participants = participants.size();
    SignFlipLimits limits;
    limits.seed = settings.seed;
    level.sign_flip = sign_flip(participants, limits);
    level.t_test = t_test(participants);
    level.p_equivalence = equivalence_t_test(participants, settings.bounds);
    level.mixed = fit_mixed_model(participants);
    level.mean = mean_interval(participants);
    level.order = order_bias(answers.first_interval, limits);
    return level;
}

Figures uncorrected(const Answers& answers, const Settings& settings) {
    const auto [n, k] = answers.tally;
    Figures figures;
    figures.proportion = static_cast<double>(k) / static_cast<double>(n);
    figures.chi_square = chi_square_equal(std::array{k, n - k});
    figures.p_exact = binomial_two_sided_p(k, n);
    figures.ci = wilson_interval(k, n);
    figures.ci_exact = clopper_pearson_interval(k, n);
    figures.cohens_g = cohens_g(k, n);
    figures.p_equivalence = equivalence_p(k, n, settings.bounds);
    figures.log_bf01 = log_bayes_factor_01(k, n);
    figures.participant = participant_level(answers, settings);
    figures.first_chosen = answers.order.first_chosen();
    figures.p_order = binomial_two_sided_p(figures.first_chosen, answers.order.n());
    figures.sensitivity = sensitivity(answers.order);
    figures.response_times = response_times(answers.response_times_s);
    return figures;
}

/// A figure's value where it is there, else what is not a number.
template <typename T>
double value_or_nan(const std::optional<T>& from, double T::*figure) {
    return from ? (*from).*figure : std::numeric_limits<double>::quiet_NaN();
}

constexpr std::size_t first_figures = 9; ///< of named_figures(), those of first_columns() after n and count

} // namespace

std::vector<std::optional<Figures>> figures_of(std::span<const Answers> rows, const Settings& settings) {
    std::vector<std::optional<Figures>> result(rows.size());
    std::vector<double> p_chi_square, p_sign_flip;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].tally.n > 0) {
            result[i] = uncorrected(rows[i], settings);
            p_chi_square.push_back(result[i]->chi_square.p);
            p_sign_flip.push_back(result[i]->participant.sign_flip.p);
        }
    }

    // Correct over the family: every row of the table that was tested.
    const auto p_holm = holm(p_chi_square), q_bh = benjamini_hochberg(p_chi_square),
               participants_holm = holm(p_sign_flip);
    std::size_t tested = 0;
    for (auto& figures : result) {
        if (figures) {
            figures->p_holm = p_holm[tested];
            figures->q_bh = q_bh[tested];
            figures->participant.p_holm = participants_holm[tested];
            ++tested;
        }
    }
    return result;
}

std::vector<NamedFigure> named_figures(const Figures& f) {
    const ParticipantLevel& level = f.participant;
    const double missing = std::numeric_limits<double>::quiet_NaN();
    const auto of_order = [&](auto figure) { return level.order ? figure(*level.order) : missing; };
    return {{"proportion", f.proportion},
            {"chi_square", f.chi_square.statistic},
            {"df", static_cast<double>(f.chi_square.df), true},
            {"p_chi_square", f.chi_square.p},
            {"p_exact", f.p_exact},
            {"p_holm", f.p_holm},
            {"q_bh", f.q_bh},
            {"ci_low", f.ci.low},
            {"ci_high", f.ci.high},
            {"ci_exact_low", f.ci_exact.low},
            {"ci_exact_high", f.ci_exact.high},
            {"cohens_g", f.cohens_g},
            {"p_equivalence", f.p_equivalence},
            {"bf01", std::exp(f.log_bf01)},
            {"participants", static_cast<double>(level.participants), true},
            {"p_sign_flip", level.sign_flip.p},
            {"p_sign_flip_error", level.sign_flip.standard_error},
            {"p_sign_flip_holm", level.p_holm},
            {"t", value_or_nan(level.t_test, &TTest::t)},
            {"p_t", value_or_nan(level.t_test, &TTest::p)},
            {"p_equivalence_t", level.p_equivalence.value_or(missing)},
            {"mixed_intercept", value_or_nan(level.mixed, &MixedModel::intercept)},
            {"mixed_se", value_or_nan(level.mixed, &MixedModel::standard_error)},
            {"p_mixed", value_or_nan(level.mixed, &MixedModel::p)},
            {"mixed_sd", value_or_nan(level.mixed, &MixedModel::sd)},
            {"p_heterogeneity", value_or_nan(level.mixed, &MixedModel::p_heterogeneity)},
            {"first_chosen", static_cast<double>(f.first_chosen), true},
            {"p_first", f.p_order},
            {"d_prime", f.sensitivity.d_prime},
            {"d_prime_order", f.sensitivity.d_prime_order},
            {"order_bias", f.sensitivity.bias},
            {"rt_q1", f.response_times.q1_s},
            {"rt_median", f.response_times.median_s},
            {"rt_q3", f.response_times.q3_s},
            {"mean_of_participants", value_or_nan(level.mean, &MeanInterval::mean)},
            {"ci_t_low", level.mean ? level.mean->ci.low : missing},
            {"ci_t_high", level.mean ? level.mean->ci.high : missing},
            {"first_share", value_or_nan(level.order, &OrderBias::first_share)},
            {"p_first_sign_flip", of_order([](const OrderBias& bias) { return bias.sign_flip.p; })}};
}

std::string first_columns() {
    return "\tn\treference_chosen\tproportion\tchi_square\tdf\tp_chi_square\tp_exact\tp_holm\tq_bh\tci_low\t"
           "ci_high";
}

std::string further_columns() {
    std::string text;
    const auto all = named_figures({});
    for (std::size_t i = first_figures; i < all.size(); ++i) {
        text += fmt::format("\t{}", all[i].name);
    }
    return text;
}

std::string first_fields(const Tally& tally, const std::optional<Figures>& figures) {
    std::string text = fmt::format("\t{}\t{}", tally.n, tally.reference_chosen);
    if (!figures) {
        return text + "\tn/a\tn/a\t1\tn/a\tn/a\tn/a\tn/a\tn/a\tn/a";
    }
    const auto all = named_figures(*figures);
    for (std::size_t i = 0; i < first_figures; ++i) {
        text += "\t" + exact(all[i].value);
    }
    return text;
}

std::string further_fields(const std::optional<Figures>& figures) {
    std::string text;
    const auto all = named_figures(figures.value_or(Figures{}));
    for (std::size_t i = first_figures; i < all.size(); ++i) {
        text += "\t" + (figures ? exact(all[i].value) : "n/a");
    }
    return text;
}

} // namespace stats
