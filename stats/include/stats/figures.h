// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <stats/equivalence.h>
#include <stats/mixed_model.h>
#include <stats/order.h>
#include <stats/participant_test.h>
#include <stats/proportion.h>
#include <stats/tally.h>

namespace stats {

/// Level of significance: a condition differs when p <= alpha [Jimenez2009, Table II].
inline constexpr double alpha = 0.05;

/// What the user may set.
struct Settings {
    EquivalenceBounds bounds; ///< of "no preference"
    std::uint64_t seed = 1;   ///< of everything drawn at random
};

/// The answers that one row of a table stands on.
struct Answers {
    Tally tally;
    std::vector<Tally> participants; ///< those with an answer, one element each
    OrderTally order;
    std::vector<double> response_times_s{}; ///< of answers whose time is known
    std::vector<Tally> first_interval{};    ///< of the participants, freed from preference
};

/// Quartiles of response times, in seconds; not numbers where none is known.
struct ResponseTimes {
    double q1_s = 0, median_s = 0, q3_s = 0;
};

/// What follows when the participants, not the answers, are taken as the sample.
struct ParticipantLevel {
    std::size_t participants = 0;
    SignFlip sign_flip;
    double p_holm = 1; ///< of the sign-flip test, over the table's rows
    std::optional<TTest> t_test;
    std::optional<double> p_equivalence; ///< two one-sided t-tests of the participants' proportions
    std::optional<MixedModel> mixed;
    std::optional<MeanInterval> mean; ///< of the participants' proportions, Student's t, 95 %
    std::optional<OrderBias> order;   ///< absent where a bias cannot be told from a preference
};

/// The figures of a row that has answers.
struct Figures {
    double proportion = 0; ///< of answers that chose the reference
    ChiSquare chi_square;  ///< against half and half
    double p_exact = 1;    ///< two-sided binomial
    double p_holm = 1;     ///< chi-square's p, adjusted over the table's rows
    double q_bh = 1;       ///< likewise, Benjamini and Hochberg
    Interval ci;           ///< Wilson, 95 %
    Interval ci_exact;     ///< Clopper and Pearson, 95 %
    double cohens_g = 0;
    double p_equivalence = 1; ///< two one-sided exact tests
    double log_bf01 = 0;      ///< Bayes factor for no preference, natural logarithm
    ParticipantLevel participant;
    double p_order = 1; ///< exact two-sided test of first against second interval
    std::int64_t first_chosen = 0;
    Sensitivity sensitivity;
    ResponseTimes response_times;
};

/// The figures of each row's answers, none where there is no answer; corrections run over the rows.
std::vector<std::optional<Figures>> figures_of(std::span<const Answers> rows, const Settings& settings = {});

/// The columns after a row's key: their names, and one row's values, each with a tab before it. The first are
/// those from n to ci_high, the further ones all others.
std::string first_columns();
std::string further_columns();
std::string first_fields(const Tally& tally, const std::optional<Figures>& figures);
std::string further_fields(const std::optional<Figures>& figures);

/// The same by name: a number, which is not a number where the figure is missing; whole for counts.
struct NamedFigure {
    const char* name;
    double value;
    bool whole = false;
};
std::vector<NamedFigure> named_figures(const Figures& figures);

} // namespace stats
