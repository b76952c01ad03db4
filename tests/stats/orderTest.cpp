// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/order.h>

#include <cmath>

#include <gtest/gtest.h>

namespace {

using stats::OrderTally;
using stats::sensitivity;

TEST(OrderTest, countsTheFirstInterval) {
    // Reference first: 5 of 8 chose it. Reference second: 2 of 8 chose it, so 6 chose the first interval.
    const OrderTally tally{{8, 5}, {8, 2}};
    EXPECT_EQ(tally.n(), 16);
    EXPECT_EQ(tally.first_chosen(), 11);
}

TEST(OrderTest, chanceHasNoSensitivity) {
    const auto found = sensitivity({{10, 5}, {10, 5}});
    EXPECT_NEAR(found.d_prime, 0, 1e-15);
    EXPECT_NEAR(found.d_prime_order, 0, 1e-15);
    EXPECT_NEAR(found.bias, 0, 1e-15);
}

TEST(OrderTest, alwaysTheFirstIntervalIsBiasWithoutSensitivity) {
    const auto most = sensitivity({{100, 90}, {100, 10}}); // H = F = .9
    EXPECT_NEAR(most.d_prime, 0, 1e-15);
    EXPECT_NEAR(most.d_prime_order, 0, 1e-15);
    EXPECT_NEAR(most.bias, -1.2815515655446004, 1e-12); // minus the normal's 90 % quantile
    const auto all = sensitivity({{10, 10}, {10, 0}});
    EXPECT_NEAR(all.d_prime, 0, 1e-15);
    EXPECT_TRUE(std::isnan(all.d_prime_order));
    EXPECT_EQ(all.bias, -INFINITY);
}

TEST(OrderTest, withoutBiasBothFormsAgree) {
    // H = 1 - F = .75: sqrt(2) z(.75), z(.75) from a table.
    const auto found = sensitivity({{20, 15}, {20, 15}});
    EXPECT_NEAR(found.d_prime, std::sqrt(2) * 0.6744897501960817, 1e-12);
    EXPECT_NEAR(found.d_prime_order, found.d_prime, 1e-12);
}

TEST(OrderTest, biasHidesSensitivityFromTheProportionAlone) {
    // A biased observer is more sensitive than the proportion tells.
    const auto found = sensitivity({{100, 98}, {100, 40}});
    EXPECT_GT(found.d_prime_order, found.d_prime);
    EXPECT_EQ(sensitivity({{9, 9}, {9, 9}}).d_prime, INFINITY);
    EXPECT_TRUE(std::isnan(sensitivity({}).d_prime));
}

TEST(OrderTest, neitherFormShowsMinusZero) {
    EXPECT_FALSE(std::signbit(sensitivity({{10, 5}, {10, 5}}).bias));
}

TEST(OrderTest, theFirstIntervalIsFreedFromPreference) {
    // Always the reference: H = 1, F = 0, however often it came first.
    const std::vector<OrderTally> preference{{{3, 3}, {1, 1}}}, habit{{{3, 3}, {1, 0}}};
    EXPECT_EQ(stats::first_interval(preference), (stats::Tally{6, 3}));
    EXPECT_EQ(stats::first_interval(habit), (stats::Tally{6, 6}));
    // One order a condition: an easy one with the reference first, a hard one with it second, tell nothing.
    const std::vector<OrderTally> confounded{{{5, 5}, {0, 0}}, {{0, 0}, {5, 2}}};
    EXPECT_EQ(stats::first_interval(confounded).n, 0);
    EXPECT_EQ(stats::in_both_orders(confounded).n(), 0);
    EXPECT_FALSE(stats::order_bias(std::vector{stats::first_interval(confounded)}));
}

TEST(OrderTest, participantsAreTheSampleOfTheBias) {
    // Surpluses for the first interval 2, 2, 2 and -2 of 4: all sign patterns but the six of two signs each.
    const std::vector<stats::Tally> participants{{4, 3}, {4, 3}, {4, 3}, {4, 1}, {0, 0}};
    const auto bias = stats::order_bias(participants).value();
    EXPECT_EQ(bias.participants, 4u);
    EXPECT_EQ(bias.first_share, 0.625);
    EXPECT_EQ(bias.sign_flip.p, 10.0 / 16);
}

TEST(OrderTest, answersThatHangOnTheOrderHaveFishersP) {
    // R: fisher.test(matrix(c(8, 2, 1, 9), 2))$p.value, and the tea of [Fisher1935]: 3, 1, 1, 3.
    EXPECT_NEAR(stats::order_p({{10, 8}, {10, 1}}), 0.005477494641581329, 1e-12);
    EXPECT_NEAR(stats::order_p({{4, 3}, {4, 1}}), 34.0 / 70, 1e-12);
    EXPECT_EQ(stats::order_p({{4, 3}, {0, 0}}), 1);
    EXPECT_NEAR(stats::order_p({{9, 9}, {9, 9}}), 1, 1e-12);
}

} // namespace
