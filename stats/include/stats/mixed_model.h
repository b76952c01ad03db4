// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <span>
#include <vector>

#include <stats/tally.h>

namespace stats {

/// Points of the quadrature over a participant's own preference.
inline constexpr int quadrature_points = 101;

/// Nodes and weights of Gauss-Hermite quadrature for the standard normal: the sum of weight * f(node) is the
/// mean of f, exact for polynomials of degree below 2 * points [Abramowitz1964, 25.4.46].
struct Quadrature {
    std::vector<double> nodes, weights;
};
Quadrature normal_quadrature(int points);

/// Logistic model with a random intercept: logit P(reference) = intercept + sd * u, u a standard normal of
/// each participant's own [Pinheiro1995].
struct MixedModel {
    double intercept = 0;      ///< logit of the proportion of a median participant; 0: no preference
    double standard_error = 0; ///< of the intercept, by observed information
    double sd = 0;             ///< between participants, on the logit scale
    double p = 1;              ///< of the intercept, Wald, two-sided
    double log_likelihood = 0; ///< without the binomial coefficients
    /// Of the hypothesis sd = 0: likelihood ratio against an equal mixture of chi-square with df 0 and 1
    /// [Self1987].
    double p_heterogeneity = 1;
};

/// The model by maximum likelihood, with adaptive Gauss-Hermite quadrature, and the trapezoidal rule for
/// participants who always answered the same. Nothing where it cannot be estimated - fewer than two
/// participants with answers, none with two answers, all answers the same, every participant always answering
/// the same, an sd above 25 - or not reliably: half the points give another standard error.
std::optional<MixedModel> fit_mixed_model(std::span<const Tally> participants);

} // namespace stats
