// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/exports.h>

#include <gtest/gtest.h>

#include "study_folder.h"

namespace {

TEST(ExportsTest, trialsHaveOneRowEach) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rn"));
    folder.write_log("01", log_text("t"), "_run-02"); // incomplete: left out
    EXPECT_EQ(
        trials_tsv(stats::read_study(folder.path())),
        "participant_id\trun\ttrial\treference\ttest\tdistance\tazimuth_deg\treference_first\tresponse\t"
        "reference_chosen\tfirst_chosen\tresponse_time\tonset_first\tonset_grey\tonset_second\tsimulated\n"
        "sub-01\t1\t1\tts\tss_full\tfar\t60\t1\t1\t1\t1\t1.5\t0.25\t3.25\t5.25\tfalse\n"
        "sub-01\t1\t2\tts\tss_full\tfar\t60\t1\tn/a\tn/a\tn/a\t1.5\t0.25\t3.25\t5.25\tfalse\n");
}

TEST(ExportsTest, theReferenceSecondIsCodedSo) {
    const StudyFolder folder;
    folder.write_log("01", log_header + "1\tts\tno_sss\tfar\t0\tno_sss\tts\t2\tts\tn/a\t0\t0\t0\n");
    const std::string text = trials_tsv(stats::read_study(folder.path()));
    EXPECT_NE(text.find("\tno_sss\tfar\t0\t0\t2\t1\t0\tn/a\t0\t0\t0\tfalse\n"), std::string::npos) << text;
}

TEST(ExportsTest, comparisonsAreAsPwcmpReadsThem) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rtn"), "_run-03");
    EXPECT_EQ(comparisons_csv(stats::read_study(folder.path())),
              "observer,session,scene,condition_A,condition_B,is_A_selected\n"
              "sub-01,3,far_60,ts,ss_full,1\n"
              "sub-01,3,far_60,ts,ss_full,0\n");
}

TEST(ExportsTest, countsAddUpToTheTable) {
    const StudyFolder folder;
    folder.write_published_logs();
    const std::string text = comparisons_csv(stats::read_study(folder.path()));
    std::int64_t published = 0, exported = 0;
    for (const PublishedCell& cell : published_table2) {
        published += cell.reference_chosen;
    }
    for (auto at = text.find(",1\n"); at != std::string::npos; at = text.find(",1\n", at + 1)) {
        ++exported;
    }
    EXPECT_EQ(exported, published);
}

} // namespace
