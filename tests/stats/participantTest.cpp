// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/participant_test.h>

#include <cmath>

#include <gtest/gtest.h>

#include <support/random.h>

namespace {

using stats::sign_flip;
using stats::Tally;
using Tallies = std::vector<Tally>;

Tallies random_tallies(support::Generator& generator, std::size_t most) {
    Tallies tallies(1 + generator.below(most));
    for (Tally& tally : tallies) {
        tally.n = static_cast<std::int64_t>(generator.below(9));
        tally.reference_chosen =
            static_cast<std::int64_t>(generator.below(static_cast<std::uint64_t>(tally.n) + 1));
    }
    return tallies;
}

/// The definition: every sign pattern, one after the other.
double p_by_enumeration(const Tallies& tallies) {
    std::int64_t observed = 0, as_far = 0;
    for (const Tally& tally : tallies) {
        observed += 2 * tally.reference_chosen - tally.n;
    }
    const std::uint64_t patterns = std::uint64_t{1} << tallies.size();
    for (std::uint64_t pattern = 0; pattern < patterns; ++pattern) {
        std::int64_t sum = 0;
        for (std::size_t i = 0; i < tallies.size(); ++i) {
            const std::int64_t surplus = 2 * tallies[i].reference_chosen - tallies[i].n;
            sum += (pattern >> i & 1) != 0 ? surplus : -surplus;
        }
        as_far += std::abs(sum) >= std::abs(observed) ? 1 : 0;
    }
    return static_cast<double>(as_far) / static_cast<double>(patterns);
}

TEST(ParticipantTest, signFlipIsTheShareOfAllSignPatterns) {
    support::Generator generator("sign flip test", 1);
    for (int i = 0; i < 300; ++i) {
        const Tallies tallies = random_tallies(generator, 12);
        const auto found = sign_flip(tallies);
        EXPECT_TRUE(found.exact);
        EXPECT_NEAR(found.p, p_by_enumeration(tallies), 1e-14) << i; // sums of powers of one half
    }
}

TEST(ParticipantTest, signFlipHasTheValueWorkedOutByHand) {
    // 172 of the 1024 patterns of these ten participants, 18 answers each, are as extreme.
    Tallies tallies;
    for (const std::int64_t k : {17, 4, 15, 6, 18, 9, 16, 5, 14, 12}) {
        tallies.push_back({18, k});
    }
    EXPECT_EQ(sign_flip(tallies).p, 172.0 / 1024);
    EXPECT_NEAR(stats::t_test(tallies).value().p, 0.1505, 5e-5); // printed to four digits
}

TEST(ParticipantTest, unanimousParticipantsHaveThePowerOfOneHalf) {
    for (const int m : {1, 2, 5, 16, 200, 1000}) { // down to 2^-999, about 1e-301
        EXPECT_DOUBLE_EQ(sign_flip(Tallies(static_cast<std::size_t>(m), {72, 72})).p, std::ldexp(2, -m)) << m;
        EXPECT_DOUBLE_EQ(sign_flip(Tallies(static_cast<std::size_t>(m), {72, 0})).p, std::ldexp(2, -m)) << m;
    }
    // Of different sizes, so that no binomial stands in for the distribution.
    Tallies mixed(400, {3, 3});
    mixed.resize(900, {5, 5});
    EXPECT_DOUBLE_EQ(sign_flip(mixed).p, std::ldexp(2, -900));
}

TEST(ParticipantTest, signFlipIgnoresWhoHasNoSurplusAndWhichShaderIsWhich) {
    support::Generator generator("sign flip test", 2);
    for (int i = 0; i < 50; ++i) {
        Tallies tallies = random_tallies(generator, 20), mirrored;
        for (const Tally& tally : tallies) {
            mirrored.push_back({tally.n, tally.n - tally.reference_chosen});
        }
        const double p = sign_flip(tallies).p;
        EXPECT_EQ(sign_flip(mirrored).p, p);
        tallies.push_back({6, 3});
        tallies.push_back({0, 0});
        EXPECT_EQ(sign_flip(tallies).p, p);
    }
    EXPECT_EQ(sign_flip({}).p, 1);
    EXPECT_EQ(sign_flip(Tallies{{7, 7}}).p, 1); // one participant alone says nothing
}

TEST(ParticipantTest, drawnPatternsComeWithinTheirError) {
    support::Generator generator("sign flip test", 3);
    stats::SignFlipLimits limits;
    limits.most_additions = 0;
    limits.draws = 20'000;
    for (int i = 0; i < 20; ++i) {
        Tallies tallies = random_tallies(generator, 40);
        tallies.push_back({3, 3});
        tallies.push_back({8, 7}); // two sizes of surplus at least, so that the binomial does not answer
        tallies.push_back({40, 36});
        limits.seed = static_cast<std::uint64_t>(i);
        const auto drawn = sign_flip(tallies, limits), again = sign_flip(tallies, limits);
        EXPECT_FALSE(drawn.exact);
        EXPECT_EQ(drawn.p, again.p);
        // Five standard errors: one false alarm in a million and more.
        EXPECT_NEAR(drawn.p, sign_flip(tallies).p, 5 * drawn.standard_error + 1.0 / 20'000) << i;
        EXPECT_NEAR(drawn.standard_error, std::sqrt(drawn.p * (1 - drawn.p) / 20'000), 1e-12);
    }
}

TEST(ParticipantTest, tTestNeedsParticipantsWhoDiffer) {
    EXPECT_FALSE(stats::t_test({}));
    EXPECT_FALSE(stats::t_test(Tallies{{18, 17}}));
    EXPECT_FALSE(stats::t_test(Tallies{{18, 9}, {2, 1}, {0, 0}}));
    EXPECT_FALSE(stats::equivalence_t_test(Tallies{{18, 17}}));
    // Two participants: t with one degree of freedom is Cauchy's distribution. Mean .6, half-difference .1.
    const auto found = stats::t_test(Tallies{{10, 5}, {10, 7}, {0, 0}});
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->t, 1, 1e-12);
    EXPECT_EQ(found->df, 1);
    EXPECT_NEAR(found->p, 0.5, 1e-12);
}

TEST(ParticipantTest, equivalenceIsSymmetricAndGrowsWithTheBounds) {
    const Tallies tallies{{24, 12}, {24, 14}, {24, 11}, {24, 15}, {24, 13}};
    Tallies mirrored;
    for (const Tally& tally : tallies) {
        mirrored.push_back({tally.n, tally.n - tally.reference_chosen});
    }
    const double p = stats::equivalence_t_test(tallies, {0.4, 0.6}).value();
    EXPECT_NEAR(stats::equivalence_t_test(mirrored, {0.4, 0.6}).value(), p, 1e-14);
    EXPECT_LT(stats::equivalence_t_test(tallies, {0.35, 0.65}).value(), p);
    EXPECT_GT(stats::equivalence_t_test(tallies, {0.45, 0.55}).value(), p);
}

TEST(ParticipantTest, theIntervalOfTheMeanIsStudents) {
    // R: t.test(c(17,4,15,6,18,9,16,5,14,12) / 18)$conf.int
    const std::vector<stats::Tally> example{{18, 17}, {18, 4},  {18, 15}, {18, 6},  {18, 18},
                                            {18, 9},  {18, 16}, {18, 5},  {18, 14}, {18, 12}};
    const auto found = stats::mean_interval(example).value();
    EXPECT_NEAR(found.mean, 116.0 / 180, 1e-15);
    EXPECT_NEAR(found.ci.low, 0.436499021286916, 1e-12);
    EXPECT_NEAR(found.ci.high, 0.852389867601973, 1e-12);
    // It stays a proportion, and needs a spread.
    EXPECT_EQ(stats::mean_interval(std::vector<stats::Tally>{{9, 9}, {9, 8}})->ci.high, 1);
    EXPECT_FALSE(stats::mean_interval(std::vector<stats::Tally>{{9, 4}, {18, 8}}));
    EXPECT_FALSE(stats::mean_interval(std::vector<stats::Tally>{{9, 4}}));
}

TEST(ParticipantTest, theLeastPIsThatOfOneMind) {
    for (std::size_t participants = 1; participants <= 12; ++participants) {
        const std::vector<stats::Tally> one_mind(participants, {7, 7});
        EXPECT_NEAR(stats::least_sign_flip_p(participants), stats::sign_flip(one_mind).p, 1e-15);
    }
    EXPECT_EQ(stats::least_sign_flip_p(100'000), 0);
}

} // namespace
