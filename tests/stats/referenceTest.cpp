// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

// Every figure of the analysis beside the value that R gives for it; reference.R made reference.tsv.

#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <stats/equivalence.h>
#include <stats/mixed_model.h>
#include <stats/multiplicity.h>
#include <stats/order.h>
#include <stats/participant_test.h>
#include <stats/power.h>
#include <stats/proportion.h>
#include <stats/two_groups.h>

namespace {

using Arguments = std::vector<double>;

std::int64_t whole(double value) { return std::llround(value); }

std::vector<stats::Tally> participants(const Arguments& pairs) {
    std::vector<stats::Tally> tallies;
    for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
        tallies.push_back({whole(pairs[i + 1]), whole(pairs[i])});
    }
    return tallies;
}

stats::OrderTally order(const Arguments& a) {
    return {{whole(a[1]), whole(a[0])}, {whole(a[3]), whole(a[2])}};
}

/// The arguments after the first: the first group's values, and the second's.
std::pair<Arguments, Arguments> groups(const Arguments& a) {
    const auto border = a.begin() + 1 + whole(a[0]);
    return {{a.begin() + 1, border}, {border, a.end()}};
}

stats::ChiSquare chi_square(const Arguments& a) {
    return stats::chi_square_equal(std::array{whole(a[0]), whole(a[1] - a[0])});
}

double element(const std::vector<double>& values, const Arguments& a) {
    return values.at(static_cast<std::size_t>(a[0]) - 1);
}

/// A figure of ours, and how far it may lie from R's, relative to the larger of 1 and the value, or of the
/// value alone.
struct Figure {
    std::function<double(const Arguments&)> value;
    double tolerance = 1e-9; ///< what is promised
    bool relative = true;
};

const std::map<std::string, Figure>& figures() {
    using namespace stats;
    // lme4 stops within about 1e-6 of the maximum, and differentiates numerically.
    constexpr double lme4 = 5e-4, lme4_optimum = 1e-5;
    static const std::map<std::string, Figure> all{
        {"chi_square", {[](auto& a) { return chi_square(a).statistic; }}},
        {"p_chi_square", {[](auto& a) { return chi_square(a).p; }}},
        {"p_exact", {[](auto& a) { return binomial_two_sided_p(whole(a[0]), whole(a[1])); }}},
        {"wilson_low", {[](auto& a) { return wilson_interval(whole(a[0]), whole(a[1])).low; }}},
        {"wilson_high", {[](auto& a) { return wilson_interval(whole(a[0]), whole(a[1])).high; }}},
        {"clopper_low", {[](auto& a) { return clopper_pearson_interval(whole(a[0]), whole(a[1])).low; }}},
        {"clopper_high", {[](auto& a) { return clopper_pearson_interval(whole(a[0]), whole(a[1])).high; }}},
        {"equivalence", {[](auto& a) {
             return equivalence_p(whole(a[0]), whole(a[1]), {a[2], a[3]});
         }}},
        // Logarithms pass through 0; R's lbeta of a million is itself good to 1e-10 or so.
        {"log_bf01", {[](auto& a) { return log_bayes_factor_01(whole(a[0]), whole(a[1])); }, 1e-9, false}},
        {"holm", {[](auto& a) { return element(holm(std::span(a).subspan(1)), a); }}},
        {"bh", {[](auto& a) { return element(benjamini_hochberg(std::span(a).subspan(1)), a); }}},
        {"sign_flip", {[](auto& a) { return sign_flip(participants(a)).p; }}},
        {"t_test", {[](auto& a) { return t_test(participants(a)).value().p; }}},
        {"equivalence_t", {[](auto& a) { return equivalence_t_test(participants(a)).value(); }}},
        {"log_likelihood", {[](auto& a) { return fit_mixed_model(participants(a)).value().log_likelihood; }}},
        {"heterogeneity",
         {[](auto& a) { return fit_mixed_model(participants(a)).value().p_heterogeneity; }, 1e-7}},
        {"mixed_sd", {[](auto& a) { return fit_mixed_model(participants(a)).value().sd; }, lme4_optimum}},
        {"mixed_intercept",
         {[](auto& a) { return fit_mixed_model(participants(a)).value().intercept; }, lme4_optimum, false}},
        {"mixed_error",
         {[](auto& a) { return fit_mixed_model(participants(a)).value().standard_error; }, lme4}},
        {"rank_sum_w", {[](auto& a) { return rank_sum_test(groups(a).first, groups(a).second).value().w; }}},
        {"rank_sum_p", {[](auto& a) { return rank_sum_test(groups(a).first, groups(a).second).value().p; }}},
        {"welch_p", {[](auto& a) { return welch_test(groups(a).first, groups(a).second).value().p; }}},
        {"quantile", {[](auto& a) { return quantile(std::span(a).subspan(1), a[0]); }}},
        {"d_prime", {[](auto& a) { return sensitivity(order(a)).d_prime; }}},
        {"d_prime_order", {[](auto& a) { return sensitivity(order(a)).d_prime_order; }}},
        {"order_bias", {[](auto& a) { return sensitivity(order(a)).bias; }}},
        {"power", {[](auto& a) { return exact_power(whole(a[0]), a[1], a[2]); }}},
        {"trials_needed", {[](auto& a) { return static_cast<double>(trials_needed(a[0], a[1], a[2])); }, 0}},
        {"detectable", {[](auto& a) { return detectable_proportion(whole(a[0]), a[1], a[2]); }}},
        {"median_logit",
         {[](auto& a) { return median_logit(a[0], a[1]); }, 1e-8}}, // as good as uniroot and integrate
    };
    return all;
}

TEST(ReferenceTest, everyFigureAgreesWithR) {
    std::ifstream file(STATS_REFERENCE);
    std::map<std::string, int> compared;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with('#')) {
            continue;
        }
        std::istringstream fields(line);
        std::string name, arguments_text, value_text;
        std::getline(fields, name, '\t');
        std::getline(fields, arguments_text, '\t');
        std::getline(fields, value_text);
        std::istringstream numbers(arguments_text);
        const Arguments arguments{std::istream_iterator<double>(numbers), {}};

        const Figure& figure = figures().at(name);
        const double expected = std::stod(value_text), found = figure.value(arguments);
        const double scale = figure.relative ? std::abs(expected) : std::max(1.0, std::abs(expected));
        // R itself gives differences of a few 1e-16 where the answer is 0.
        EXPECT_LE(std::abs(found - expected), figure.tolerance * scale + 1e-307)
            << line << ", found " << fmt::format("{}", found);
        ++compared[name];
    }
    EXPECT_EQ(compared.size(), figures().size());
    EXPECT_GE(compared["p_exact"], 180);
}

} // namespace
