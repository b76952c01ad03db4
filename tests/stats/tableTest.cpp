// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/table.h>

#include <charconv>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "findings.h"
#include "labels.h"
#include "study_folder.h"
#include "table_text.h"

namespace {

using stats::Row;

stats::Row row(const std::string& test, const std::string& distance, double azimuth_deg, stats::Tally tally) {
    return {{"ts", test, distance, azimuth_deg},
            tally,
            stats::figures_of(std::array{stats::Answers{tally, {}, {}, {}}}).front()};
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);) {
        parts.push_back(part);
    }
    return parts;
}

std::vector<Row> published_rows() {
    const StudyFolder folder;
    folder.write_published_logs();
    return make_table(stats::read_study(folder.path()));
}

TEST(TableTest, publishedCountsGiveThePaperToThePrintedDigit) {
    const auto rows = published_rows();
    ASSERT_EQ(rows.size(), published_table2.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const PublishedCell& cell = published_table2[i];
        const auto& [condition, tally, figures] = rows[i];
        EXPECT_EQ(condition, (stats::Condition{"ts", std::string(cell.test), std::string(cell.distance),
                                               static_cast<double>(cell.azimuth_deg)}));
        EXPECT_EQ(tally.n, 32);
        EXPECT_EQ(tally.reference_chosen, cell.reference_chosen);
        ASSERT_TRUE(figures);
        EXPECT_EQ(stats::statistic_text(figures->chi_square.statistic), cell.chi_square) << i;
        EXPECT_EQ(stats::p_text(figures->chi_square.p), cell.p) << i;
        // The paper sets p > .05 in bold: every SS Full but the one at zoom, 110 degrees.
        EXPECT_EQ(significant(rows[i]), cell.test != "ss_full" || cell.p == "0.034") << i;
    }
}

TEST(TableTest, thePapersOneDifferenceOfSsFullDoesNotSurviveHolm) {
    // 24 p-values are smaller, so Holm multiplies .0339 by 36 - 24 = 12; its rank is 25, so BH by 36 / 25.
    const auto rows = published_rows();
    const Row& zoom_110 = rows[32];
    ASSERT_EQ(zoom_110.condition, (stats::Condition{"ts", "ss_full", "zoom", 110}));
    const double p = zoom_110.figures->chi_square.p;
    EXPECT_NEAR(zoom_110.figures->p_holm, 12 * p, 1e-15); // one rounding
    EXPECT_NEAR(zoom_110.figures->q_bh, 36.0 / 25 * p, 1e-15);
    const auto count = stats::significance(rows);
    EXPECT_EQ(count.tests, 36u);
    EXPECT_EQ(count.raw, 25u);
    EXPECT_EQ(count.holm, 24u);
    EXPECT_EQ(count.bh, 25u);
}

TEST(TableTest, unknownNamesStandAfterTheKnownOnes) {
    const std::vector<stats::Condition> order{
        {"ts", "no_sss", "far", 0},     {"ts", "ss_jittered", "far", 0}, {"ts", "ss_full", "far", 0},
        {"ts", "aaa", "far", 0},        {"ts", "bbb", "far", 0},         {"ts", "no_sss", "far", 9},
        {"ts", "no_sss", "far", 10},    {"aa", "ts", "near", 0},         {"ts", "no_sss", "near", 0},
        {"ts", "no_sss", "zoom", -1.5}, {"ts", "no_sss", "close", 0},    {"ts", "no_sss", "mid", 0}};
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (std::size_t j = 0; j < order.size(); ++j) {
            EXPECT_EQ(stats::paper_order(order[i], order[j]), i < j) << i << " " << j;
        }
    }
}

TEST(TableTest, unansweredTrialsAreLeftOut) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rnrtn") + log_line(6, 'n', "no_sss"));
    const auto rows = make_table(stats::read_study(folder.path()));
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].tally.n, 0);
    EXPECT_FALSE(rows[0].figures);
    EXPECT_EQ(rows[1].tally.n, 3);
    EXPECT_EQ(rows[1].tally.reference_chosen, 2);
    EXPECT_DOUBLE_EQ(rows[1].figures->p_holm, rows[1].figures->chi_square.p); // a family of one
    EXPECT_NE(to_tsv(rows, false).find("\t0\t0\tn/a\tn/a\t1\tn/a\tn/a\tn/a\tn/a\tn/a\tn/a\tfalse\tn/a\t"),
              std::string::npos);
}

TEST(TableTest, runsLeftOutAreNotCounted) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rrr"));
    folder.write_log("01", log_text("ttt"), "_run-02");
    const auto rows = make_table(stats::read_study(folder.path()));
    EXPECT_EQ(rows.front().tally.n, 3);
    EXPECT_EQ(rows.front().tally.reference_chosen, 0);
}

TEST(TableTest, tsvHasItsColumnsAndReadsBackExactly) {
    const auto rows = published_rows();
    const auto lines = split(to_tsv(rows, true), '\n');
    ASSERT_EQ(lines.size(), 37u);
    EXPECT_TRUE(lines[0].starts_with("reference\ttest\tdistance\tazimuth_deg\tn\treference_"
                                     "chosen\tproportion\tchi_square\tdf\tp_chi_square\t"
                                     "p_exact\tp_holm\tq_bh\tci_low\tci_high"));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto fields = split(lines[i + 1], '\t');
        ASSERT_EQ(fields.size(), 46u);
        const auto value = [&](std::size_t column) {
            double number = 0;
            std::from_chars(fields[column].data(), fields[column].data() + fields[column].size(), number);
            return number;
        };
        const auto& f = *rows[i].figures;
        EXPECT_EQ(fields[1], rows[i].condition.test);
        EXPECT_EQ(value(6), f.proportion);
        EXPECT_EQ(value(7), f.chi_square.statistic);
        EXPECT_EQ(fields[8], "1");
        EXPECT_EQ(value(9), f.chi_square.p);
        EXPECT_EQ(value(10), f.p_exact);
        EXPECT_EQ(value(11), f.p_holm);
        EXPECT_EQ(value(12), f.q_bh);
        EXPECT_EQ(value(13), f.ci.low);
        EXPECT_EQ(value(14), f.ci.high);
        EXPECT_EQ(fields[15], "true");
    }
}

TEST(TableTest, furtherColumnsHoldTheFiguresTheyName) {
    // Each column beside the function whose figure it is; the counts of one published condition.
    const auto rows = published_rows();
    const Row& one = rows[32];
    const auto lines = split(to_tsv(rows, false), '\n');
    const auto names = split(lines[0], '\t'), fields = split(lines[33], '\t');
    const auto value = [&](const std::string& name) {
        const auto at = std::find(names.begin(), names.end(), name) - names.begin();
        return fields.at(static_cast<std::size_t>(at));
    };
    const auto [n, k] = one.tally;
    // Participants 0 to 10 chose the reference twice, the other five never.
    std::vector<stats::Tally> participants(11, {2, 2});
    participants.resize(16, {2, 0});
    const std::pair<const char*, double> expected[] = {
        {"ci_exact_low", stats::clopper_pearson_interval(k, n).low},
        {"ci_exact_high", stats::clopper_pearson_interval(k, n).high},
        {"cohens_g", stats::cohens_g(k, n)},
        {"p_equivalence", stats::equivalence_p(k, n)},
        {"bf01", std::exp(stats::log_bayes_factor_01(k, n))},
        {"participants", 16},
        {"p_sign_flip", stats::sign_flip(participants).p},
        {"p_sign_flip_error", 0},
        {"t", stats::t_test(participants)->t},
        {"p_t", stats::t_test(participants)->p},
        {"p_equivalence_t", stats::equivalence_t_test(participants).value()},
        {"mixed_intercept", NAN}, // each participant is of one mind
        {"first_chosen", 11 + 5},
        {"p_first", 1},
        {"d_prime", stats::sensitivity({{16, 11}, {16, 11}}).d_prime},
        {"d_prime_order", stats::sensitivity({{16, 11}, {16, 11}}).d_prime_order},
        {"order_bias", stats::sensitivity({{16, 11}, {16, 11}}).bias},
        {"rt_q1", 1.5},
        {"rt_median", 1.5},
        {"rt_q3", 1.5}};
    for (const auto& [name, number] : expected) {
        EXPECT_EQ(value(name), stats::exact(number)) << name;
    }
}

TEST(TableTest, numbersAreShortestRoundTrips) {
    EXPECT_EQ(stats::exact(0.1), "0.1");
    EXPECT_EQ(stats::exact(32), "32");
    EXPECT_EQ(stats::exact(1e-300), "1e-300");
    EXPECT_EQ(stats::exact(-INFINITY), "-inf");
    EXPECT_EQ(stats::exact(NAN), "n/a");
}

TEST(TableTest, textShowsThePapersRows) {
    const std::string text = table2_text(stats::paper_grid(published_rows()), false);
    EXPECT_NE(text.find("n = 32"), std::string::npos);
    std::set<std::size_t> widths;
    for (const std::string& line : split(text, '\n')) {
        if (line.starts_with("TS - ")) {
            const auto mark = line.ends_with(" *") ? 2u : 0u;
            // Columns are aligned when all lines are as long in characters; the degree sign has two bytes.
            widths.insert(line.size() - mark - 1);
        }
    }
    EXPECT_EQ(widths.size(), 1u);
    std::istringstream line(text.substr(text.find("TS - Zoom - 60")));
    std::vector<std::string> words;
    for (std::string word; words.size() < 12 && line >> word;) {
        words.push_back(word);
    }
    EXPECT_EQ(words, (std::vector<std::string>{"TS", "-", "Zoom", "-", "60\u00b0", "28.125", "0.000", "18",
                                               "0.000", "2", "0.157", "*"}));
}

TEST(TableTest, textShowsMissingConditionsAndUnequalCounts) {
    const std::vector<Row> rows{row("no_sss", "far", 0, {30, 29}), row("ss_full", "far", 0, {0, 0}),
                                row("no_sss", "far", 60, {32, 20})};
    const stats::Grid grid = stats::paper_grid(rows);
    EXPECT_FALSE(grid.n);
    ASSERT_EQ(grid.lines.size(), 2u);
    EXPECT_EQ(grid.lines[1].cells[1], nullptr);
    const std::string text = table2_text(grid, true);
    EXPECT_NE(text.find("    30     26.133    0.000"), std::string::npos) << text;
    EXPECT_NE(text.find("     0        n/a      n/a\n"), std::string::npos) << text;
    EXPECT_NE(text.find("   n/a        n/a      n/a\n"), std::string::npos) << text;
    EXPECT_NE(text.find("\x1b[1m          2    0.157 *\x1b[0m"), std::string::npos) << text;
}

} // namespace
