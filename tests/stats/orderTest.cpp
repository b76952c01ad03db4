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

} // namespace
