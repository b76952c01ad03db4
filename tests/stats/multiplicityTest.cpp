// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/multiplicity.h>

#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include <support/random.h>

namespace {

using stats::benjamini_hochberg;
using stats::holm;

void expect_all_near(const std::vector<double>& found, const std::vector<double>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i], expected[i], 1e-15) << i; // one rounding of a product
    }
}

/// Small p-values with ties.
std::vector<double> random_p_values(support::Generator& generator) {
    std::vector<double> values(1 + generator.below(12));
    for (double& value : values) {
        value = static_cast<double>(generator.below(40)) / 400 * generator.uniform();
        value = generator.below(4) == 0 ? values.front() : value;
    }
    return values;
}

// By hand: 5 x .01, 4 x .02, 3 x .03, then no less; and 5/i x p_i = .05 each.
// R's p.adjust gives the same.
TEST(MultiplicityTest, hasReferenceValues) {
    const std::vector<double> p{0.01, 0.02, 0.03, 0.04, 0.05};
    expect_all_near(holm(p), {0.05, 0.08, 0.09, 0.09, 0.09});
    expect_all_near(benjamini_hochberg(p), {0.05, 0.05, 0.05, 0.05, 0.05});
}

TEST(MultiplicityTest, keepsTheOrderGiven) {
    expect_all_near(holm(std::vector<double>{0.9, 0.001, 0.02}), {0.9, 0.003, 0.04});
    expect_all_near(benjamini_hochberg(std::vector<double>{0.9, 0.001, 0.02}), {0.9, 0.003, 0.03});
}

TEST(MultiplicityTest, neverExceedsOne) {
    expect_all_near(holm(std::vector<double>{0.6, 1, 0.7}), {1, 1, 1});
    expect_all_near(benjamini_hochberg(std::vector<double>{1, 1}), {1, 1});
    EXPECT_TRUE(holm({}).empty());
    EXPECT_TRUE(benjamini_hochberg({}).empty());
}

TEST(MultiplicityTest, holmDecidesAsTheStepDownProcedure) {
    // The procedure [Holm1979]: from the smallest p on, reject while p <= alpha / (tests left).
    support::Generator generator("holm", 1);
    for (int round = 0; round < 500; ++round) {
        const auto p = random_p_values(generator), adjusted = holm(p);
        const double alpha = 0.001 + 0.3 * generator.uniform();
        auto sorted = p;
        std::sort(sorted.begin(), sorted.end());
        std::size_t rejected = 0;
        while (rejected < sorted.size() &&
               sorted[rejected] <= alpha / static_cast<double>(sorted.size() - rejected)) {
            ++rejected;
        }
        EXPECT_EQ(static_cast<std::size_t>(
                      std::count_if(adjusted.begin(), adjusted.end(), [&](double q) { return q <= alpha; })),
                  rejected);
    }
}

TEST(MultiplicityTest, benjaminiHochbergDecidesAsTheStepUpProcedure) {
    // The procedure [Benjamini1995]: reject the i smallest, for the largest i with p_i <= q i / m.
    support::Generator generator("bh", 1);
    for (int round = 0; round < 500; ++round) {
        const auto p = random_p_values(generator), adjusted = benjamini_hochberg(p);
        const double level = 0.001 + 0.3 * generator.uniform();
        auto sorted = p;
        std::sort(sorted.begin(), sorted.end());
        std::size_t rejected = 0;
        for (std::size_t i = 1; i <= sorted.size(); ++i) {
            if (sorted[i - 1] <= level * static_cast<double>(i) / static_cast<double>(sorted.size())) {
                rejected = i;
            }
        }
        EXPECT_EQ(static_cast<std::size_t>(
                      std::count_if(adjusted.begin(), adjusted.end(), [&](double q) { return q <= level; })),
                  rejected);
    }
}

} // namespace
