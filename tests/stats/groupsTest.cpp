// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/groups.h>

#include <charconv>
#include <sstream>

#include <gtest/gtest.h>

#include <stats/analysis.h>
#include <stats/multiplicity.h>

#include "study_folder.h"

namespace {

using stats::GroupRow;

/// Ten participants with 18 answers each, of which so many chose the reference.
void write_example(const StudyFolder& folder) {
    int participant = 0;
    for (const int k : {17, 4, 15, 6, 18, 9, 16, 5, 14, 12}) {
        folder.write_log(fmt::format("{:02}", ++participant),
                         log_text(std::string(static_cast<std::size_t>(k), 'r') +
                                  std::string(static_cast<std::size_t>(18 - k), 't')));
    }
}

const GroupRow& find(const std::vector<GroupRow>& groups, const std::string& test, const std::string& level) {
    for (const GroupRow& group : groups) {
        if (group.test == test && group.level == level) {
            return group;
        }
    }
    throw std::out_of_range(level);
}

TEST(GroupsTest, sumThePublishedCounts) {
    const StudyFolder folder;
    folder.write_published_logs();
    const auto groups = make_groups(stats::read_study(folder.path()));
    ASSERT_EQ(groups.size(), 3u * (1 + 3 + 4));
    std::int64_t all = 0, zoom = 0, azimuth_110 = 0;
    for (const PublishedCell& cell : published_table2) {
        if (cell.test == "ss_full") {
            all += cell.reference_chosen;
            zoom += cell.distance == "zoom" ? cell.reference_chosen : 0;
            azimuth_110 += cell.azimuth_deg == 110 ? cell.reference_chosen : 0;
        }
    }
    EXPECT_EQ(find(groups, "ss_full", "all").tally, (stats::Tally{384, all}));
    EXPECT_EQ(find(groups, "ss_full", "zoom").tally, (stats::Tally{128, zoom}));
    EXPECT_EQ(find(groups, "ss_full", "110").tally, (stats::Tally{96, azimuth_110}));
    // No SSS, SS Jittered, SS Full; all, far, near, zoom, 0, 60, 110, 150: as in the paper.
    EXPECT_EQ(groups[0].test, "no_sss");
    EXPECT_EQ(groups[9].level, "far");
    EXPECT_EQ(groups[23].level, "150");
    EXPECT_EQ(overall(groups).size(), 3u);
}

TEST(GroupsTest, participantsAreTheSample) {
    const StudyFolder folder;
    write_example(folder);
    const auto groups = make_groups(stats::read_study(folder.path()));
    const auto& f = groups.front().figures.value();
    EXPECT_EQ(f.participant.participants, 10u);
    EXPECT_EQ(f.participant.sign_flip.p, 172.0 / 1024); // counted by hand
    EXPECT_NEAR(f.chi_square.p, 0.000106, 5e-7);        // known to three digits
    EXPECT_NEAR(f.participant.mixed.value().intercept, 0.8867, 5e-5);
}

TEST(GroupsTest, correctionsRunOverTheRowsOfTheTable) {
    const StudyFolder folder;
    folder.write_published_logs();
    const auto groups = make_groups(stats::read_study(folder.path()));
    std::vector<double> p, p_participants;
    for (const GroupRow& group : groups) {
        p.push_back(group.figures->chi_square.p);
        p_participants.push_back(group.figures->participant.sign_flip.p);
    }
    const auto holm = stats::holm(p), bh = stats::benjamini_hochberg(p), flips = stats::holm(p_participants);
    for (std::size_t i = 0; i < groups.size(); ++i) {
        EXPECT_EQ(groups[i].figures->p_holm, holm[i]);
        EXPECT_EQ(groups[i].figures->q_bh, bh[i]);
        EXPECT_EQ(groups[i].figures->participant.p_holm, flips[i]);
    }
}

TEST(GroupsTest, tsvHasAsManyFieldsAsColumns) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rtn") + log_line(4, 'n', "no_sss") +
                               log_line(5, 'r', "ss_full", "zoom", 60) +
                               log_line(6, 'n', "ss_full", "near", 60));
    const std::string text = to_tsv(make_groups(stats::read_study(folder.path())), false);
    std::istringstream lines(text);
    std::set<std::ptrdiff_t> tabs;
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
        tabs.insert(std::count(line.begin(), line.end(), '\t'));
    }
    EXPECT_EQ(count, 1 + 1 + 4); // no_sss all; ss_full all, far, near, zoom
    EXPECT_EQ(tabs.size(), 1u);
    EXPECT_TRUE(text.starts_with("reference\ttest\tgroup\tlevel\tn\treference_chosen\tproportion"));
    EXPECT_NE(text.find("ts\tss_full\tdistance\tnear\t0\t0\tn/a"), std::string::npos);
}

/// The rows' groups and levels, in their order.
std::vector<std::string> levels_of(const std::string& log) {
    const StudyFolder folder;
    folder.write_log("01", log);
    std::vector<std::string> levels;
    for (const GroupRow& group : make_groups(stats::read_study(folder.path()))) {
        levels.push_back(group.by + " " + group.level);
    }
    return levels;
}

TEST(GroupsTest, aFactorWithOneLevelHasNoRows) {
    using Levels = std::vector<std::string>;
    const auto line = [](int trial, const char* distance, int azimuth_deg, char answer = 'r') {
        return log_line(trial, answer, "ss_full", distance, azimuth_deg);
    };
    const std::string one = log_header + line(1, "far", 60) + line(2, "far", 60);
    EXPECT_EQ(levels_of(one), (Levels{"all all"}));
    EXPECT_EQ(levels_of(one + line(3, "near", 60)), (Levels{"all all", "distance far", "distance near"}));
    EXPECT_EQ(levels_of(one + line(3, "far", 0)), (Levels{"all all", "azimuth 0", "azimuth 60"}));
    // A second level without an answer leaves the first with all of them.
    EXPECT_EQ(levels_of(one + line(3, "near", 0, 'n')), (Levels{"all all"}));
    // Another pair's levels are its own.
    EXPECT_EQ(levels_of(one + log_line(3, 'r', "no_sss", "near", 0)), (Levels{"all all", "all all"}));
}

TEST(GroupsTest, aHypothesisIsCorrectedForOnce) {
    // Six of one mind in one condition: the only hypothesis, p = 2/2^6, and nothing to correct for.
    const StudyFolder folder;
    for (int participant = 1; participant <= 6; ++participant) {
        folder.write_log(fmt::format("{}", participant), log_text("rRrR"));
    }
    const auto groups = make_groups(stats::read_study(folder.path()));
    EXPECT_EQ(groups.front().figures->participant.p_holm, 2.0 / 64);
    EXPECT_EQ(groups.front().figures->p_holm, groups.front().figures->chi_square.p);
}

TEST(GroupsTest, responseTimesAreQuartiles) {
    const StudyFolder folder;
    std::string text = log_header;
    int trial = 0;
    for (const char* time : {"1", "2", "4", "8", "16", "32", "n/a"}) {
        std::string line = log_line(++trial, 'r');
        line.replace(line.find("\t1.5\t"), 5, fmt::format("\t{}\t", time));
        text += line;
    }
    folder.write_log("01", text);
    const auto groups = make_groups(stats::read_study(folder.path()));
    const auto& times = groups.front().figures->response_times; // as R's quantile() has them
    EXPECT_EQ(times.q1_s, 2.5);
    EXPECT_EQ(times.median_s, 6);
    EXPECT_EQ(times.q3_s, 14);
}

} // namespace
