// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <vector>

namespace stats {

/// Holm's step-down adjusted p-values [Holm1979], in the order given: rejecting those <= alpha keeps the
/// probability of any false alarm in the family at or under alpha, whatever the dependence.
std::vector<double> holm(std::span<const double> p_values);

/// Benjamini and Hochberg's step-up adjusted p-values [Benjamini1995], in the order given: rejecting those
/// <= q keeps the expected share of false alarms among the rejections at or under q, for independent tests.
std::vector<double> benjamini_hochberg(std::span<const double> p_values);

} // namespace stats
