// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include <support/random.h>

namespace {

using support::Generator;

// Worked out by a second program, in Python, from the C++ standard's description of seed_seq and mt19937_64
// ([rand.util.seedseq], [rand.eng.mers]) and from SHA-256.
TEST(GeneratorTest, givesTheNumbersThatTheStandardsDefine) {
    Generator generator("a name", 42);
    EXPECT_EQ(generator.next(), 367829430800024687U);
    EXPECT_EQ(generator.next(), 17493253831446990484U);
    EXPECT_EQ(generator.next(), 7085723003726013259U);
}

TEST(GeneratorTest, dependsOnNameAndSeed) {
    const std::set<std::uint64_t> firsts{Generator("a", 1).next(), Generator("a", 2).next(),
                                         Generator("b", 1).next(), Generator("a:1", 1).next()};
    EXPECT_EQ(firsts.size(), 4U);
}

TEST(GeneratorTest, isUniformBelowN) {
    constexpr int draws = 60000;
    std::array<int, 6> counts{};
    Generator generator("die", 1);
    for (int i = 0; i < draws; ++i) {
        ++counts.at(generator.below(6));
    }
    double chi_square = 0;
    for (const int count : counts) {
        chi_square += std::pow(count - draws / 6.0, 2) / (draws / 6.0);
    }
    EXPECT_LT(chi_square, 25.7); // 5 degrees of freedom: passed once in 10,000 seeds
}

TEST(GeneratorTest, isUniformBelowOne) {
    constexpr int draws = 100000;
    Generator generator("uniform", 1);
    double sum = 0;
    double squares = 0;
    for (int i = 0; i < draws; ++i) {
        const double u = generator.uniform();
        ASSERT_GE(u, 0);
        ASSERT_LT(u, 1);
        sum += u;
        squares += u * u;
    }
    // Mean 1/2 and second moment 1/3; five standard errors of each.
    EXPECT_NEAR(sum / draws, 0.5, 5 * std::sqrt(1.0 / 12 / draws));
    EXPECT_NEAR(squares / draws, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / draws));
}

TEST(GeneratorTest, hasTheMomentsOfTheStandardNormal) {
    constexpr int draws = 100000;
    Generator generator("normal", 1);
    std::array<double, 5> sums{};
    int beyond_two = 0;
    for (int i = 0; i < draws; ++i) {
        const double z = generator.normal();
        ASSERT_TRUE(std::isfinite(z));
        for (int power = 1; power <= 4; ++power) {
            sums.at(static_cast<std::size_t>(power)) += std::pow(z, power);
        }
        beyond_two += std::abs(z) > 2 ? 1 : 0;
    }
    // Moments 0, 1, 0, 3 with the variances 1, 2, 15, 96 of their terms; five standard errors of each.
    EXPECT_NEAR(sums[1] / draws, 0, 5 * std::sqrt(1.0 / draws));
    EXPECT_NEAR(sums[2] / draws, 1, 5 * std::sqrt(2.0 / draws));
    EXPECT_NEAR(sums[3] / draws, 0, 5 * std::sqrt(15.0 / draws));
    EXPECT_NEAR(sums[4] / draws, 3, 5 * std::sqrt(96.0 / draws));
    EXPECT_NEAR(static_cast<double>(beyond_two) / draws, 0.0455, 5 * std::sqrt(0.0455 * 0.9545 / draws));
}

TEST(GeneratorTest, shufflesEveryOrderEquallyOften) {
    constexpr int draws = 24000;
    std::vector<int> counts(24);
    Generator generator("shuffle", 1);
    std::vector<std::array<int, 4>> orders;
    std::array<int, 4> order{0, 1, 2, 3};
    do {
        orders.push_back(order);
    } while (std::next_permutation(order.begin(), order.end()));
    for (int i = 0; i < draws; ++i) {
        std::vector<int> items{0, 1, 2, 3};
        generator.shuffle(items);
        const auto at = std::find_if(orders.begin(), orders.end(), [&](const auto& candidate) {
            return std::equal(candidate.begin(), candidate.end(), items.begin());
        });
        ASSERT_NE(at, orders.end());
        ++counts[static_cast<std::size_t>(at - orders.begin())];
    }
    double chi_square = 0;
    for (const int count : counts) {
        chi_square += std::pow(count - 1000.0, 2) / 1000;
    }
    EXPECT_LT(chi_square, 57.1); // 23 degrees of freedom: passed once in 10,000 seeds
}

TEST(SeedTest, staysExactInJson) {
    EXPECT_EQ(support::seed_of("jimenez2009:01"), 4478323650024061U); // by Python's hashlib
    for (int i = 0; i < 1000; ++i) {
        EXPECT_LT(support::seed_of(std::to_string(i)), std::uint64_t{1} << 53);
    }
}

} // namespace
