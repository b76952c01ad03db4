// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/log.h>

#include <gtest/gtest.h>

#include <support/error.h>

#include "study_folder.h"

namespace {

using stats::Log;
using stats::parse_log;

/// A log whose second trial's line has one text replaced by another.
std::string spoilt(const std::string& from, const std::string& to) {
    std::string line = log_line(2, 'r');
    const auto at = line.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    line.replace(at, from.size(), to);
    return log_header + log_line(1, 'r') + line + log_line(3, 't');
}

std::string error_of(const std::string& text) {
    return message_of<support::InputError>([&] { parse_log(text, "x.tsv"); });
}

void expect_error(const std::string& text, const std::string& start, const std::string& part) {
    const std::string message = error_of(text);
    EXPECT_TRUE(message.starts_with(start)) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(LogTest, readsConditionsAndAnswers) {
    const Log log = parse_log(
        log_header + log_line(1, 'r', "no_sss", "zoom", 110) + log_line(2, 't') + log_line(7, 'n'), "x.tsv");
    ASSERT_EQ(log.trials.size(), 3u);
    EXPECT_EQ(log.trials[0].condition, (stats::Condition{"ts", "no_sss", "zoom", 110}));
    EXPECT_EQ(log.trials[0].reference_chosen, true);
    EXPECT_EQ(log.trials[1].reference_chosen, false);
    EXPECT_FALSE(log.trials[2].reference_chosen.has_value());
    EXPECT_EQ(log.trials[2].number, 7);
    EXPECT_FALSE(log.torn);
}

TEST(LogTest, countsTheReferenceWhereverItWasShown) {
    const Log log = parse_log(log_header + "1\tts\tno_sss\tfar\t0\tno_sss\tts\t2\tts\t1\t0\t0\t0\n"
                                           "2\tts\tno_sss\tfar\t0\tno_sss\tts\t1\tno_sss\t1\t0\t0\t0\n",
                              "x.tsv");
    EXPECT_EQ(log.trials[0].reference_chosen, true);
    EXPECT_EQ(log.trials[1].reference_chosen, false);
}

TEST(LogTest, readsOrderAndTimes) {
    const Log log = parse_log(log_header + "1\tts\tno_sss\tfar\t0\tno_sss\tts\t2\tts\t1.25\t3\t4\t6\n" +
                                  log_line(2, 'r') + log_line(3, 't'),
                              "x.tsv");
    EXPECT_FALSE(log.trials[0].reference_first);
    EXPECT_EQ(log.trials[0].first_chosen(), false);
    EXPECT_EQ(log.trials[0].response_time_s, 1.25);
    EXPECT_EQ(log.trials[0].onset_first_s, 3);
    EXPECT_EQ(log.trials[0].onset_grey_s, 4);
    EXPECT_EQ(log.trials[0].onset_second_s, 6);
    EXPECT_EQ(log.trials[1].first_chosen(), true);
    EXPECT_EQ(log.trials[2].first_chosen(), false);
}

TEST(LogTest, allowsFurtherColumnsAndMissingTimes) {
    std::string text = log_header + "1\tts\tno_sss\tfar\t0\tts\tno_sss\tn/a\tn/a\tn/a\tn/a\tn/a\tn/a\n";
    for (auto at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 3)) {
        text.insert(at, "\t?");
    }
    EXPECT_EQ(parse_log(text, "x.tsv").trials.size(), 1u);
    EXPECT_TRUE(parse_log(log_header, "x.tsv").trials.empty());
}

TEST(LogTest, everyBadFieldNamesFileLineAndColumn) {
    expect_error(spoilt("2\tts", "0\tts"),
                 "x.tsv:3: trial: ", "expected a whole number from 1 on, found \"0\"");
    expect_error(spoilt("2\tts", "2.0\tts"), "x.tsv:3: trial: ", "\"2.0\"");
    expect_error(spoilt("2\tts", "1\tts"), "x.tsv:3: trial: ", "expected each trial once, found \"1\"");
    expect_error(spoilt("\tts\t", "\t\t"), "x.tsv:3: reference: ", "found \"\"");
    expect_error(spoilt("\tss_full\t", "\t<b>\t"), "x.tsv:3: test: ", "\"<b>\"");
    expect_error(spoilt("\tss_full\t", "\tts\t"), "x.tsv:3: test: ", "another shader than the reference");
    expect_error(spoilt("\tss_full\t", "\tss_ful\t"), "x.tsv:3: test: ",
                 "a shader (no_sss, ts, ss_jittered, ss_full, reference), found \"ss_ful\"");
    expect_error(spoilt("\tts\t", "\twax\t"), "x.tsv:3: reference: ", "a shader");
    expect_error(spoilt("far", std::string(65, 'f')), "x.tsv:3: distance: ", "1 to 64 letters");
    expect_error(spoilt("\t60\t", "\tnan\t"), "x.tsv:3: azimuth_deg: ", "\"nan\"");
    expect_error(spoilt("\t60\t", "\t1e9\t"), "x.tsv:3: azimuth_deg: ", "from -360 to 360");
    expect_error(spoilt("ts\tss_full\t1", "ts\tno_sss\t1"), "x.tsv:3: first, second: ", "\"no_sss\"");
    expect_error(spoilt("ts\tss_full\t1", "ts\tts\t1"), "x.tsv:3: first, second: ", "either order");
    expect_error(spoilt("\t1\tts\t", "\t3\tts\t"),
                 "x.tsv:3: response: ", "expected 1, 2 or n/a, found \"3\"");
    expect_error(spoilt("\t1\tts\t", "\t2\tts\t"),
                 "x.tsv:3: chosen: ", "expected ss_full, as the response is 2");
    expect_error(spoilt("\t1\tts\t", "\tn/a\tts\t"), "x.tsv:3: chosen: ", "expected n/a");
    expect_error(spoilt("\t1.5\t", "\t-1.5\t"), "x.tsv:3: response_time: ", "seconds from 0 on");
    expect_error(spoilt("\t0.25\t", "\tinf\t"), "x.tsv:3: onset_first: ", "\"inf\"");
    expect_error(spoilt("\t3.25\t", "\t3,25\t"), "x.tsv:3: onset_grey: ", "\"3,25\"");
    expect_error(spoilt("\t5.25", "\t"), "x.tsv:3: onset_second: ", "\"\"");
}

TEST(LogTest, badLinesNameFileAndLine) {
    expect_error("", "x.tsv:1: ", "empty file");
    expect_error(spoilt("\t5.25", ""), "x.tsv:3: ", "expected 13 fields separated by tabs, found 12");
    expect_error(spoilt("\t5.25", "\t5.25\t1"), "x.tsv:3: ", "found 14");
    expect_error(spoilt("5.25\n", "5.25\r\n"), "x.tsv:3: ", "carriage return");
    expect_error(log_header + "\n" + log_line(1, 'r'), "x.tsv:2: ", "found 1");
    expect_error("\xef\xbb\xbf" + log_header, "x.tsv:1: ", "byte order mark");
    expect_error("trial,reference,test\n", "x.tsv:1: ", "found commas");
    expect_error("trial;reference;test\n", "x.tsv:1: ", "found semicolons");
    expect_error("\"trial\"\t\"reference\"\n", "x.tsv:1: ", "found quotes");
    expect_error(spoilt("far", "\"far\""), "x.tsv:3: distance: ", "\"\"far\"\"");
    expect_error("trial\ttest\treference\n",
                 "x.tsv:1: ", "expected \"reference\" as column 2 of the header, found \"test\"");
    expect_error("trial\treference\n",
                 "x.tsv:1: ", "expected \"test\" as column 3 of the header, found the end");
    expect_error(log_header.substr(0, log_header.size() - 1), "x.tsv:1: ", "line break after the header");
}

TEST(LogTest, hostileFieldsStayShortInTheMessage) {
    EXPECT_LT(error_of(spoilt("far", std::string(100'000, 'x') + "!")).size(), 200u);
}

TEST(LogTest, setsALastLineWithTooFewFieldsAside) {
    const Log log = parse_log(log_text("rr") + "3\tts\tss_f\n", "x.tsv");
    EXPECT_EQ(log.trials.size(), 2u);
    ASSERT_TRUE(log.torn);
    EXPECT_EQ(log.torn->line, 4u);
    EXPECT_EQ(log.torn->why, "3 of 13 fields");
}

TEST(LogTest, cutAnywhereKeepsEveryWholeLine) {
    // What a kill or a full disk leaves behind: any prefix of the file.
    const std::string text = log_text("rtnrt");
    for (std::size_t size = log_header.size(); size < text.size(); ++size) {
        const std::string prefix = text.substr(0, size);
        const auto lines = static_cast<std::size_t>(std::count(prefix.begin(), prefix.end(), '\n'));
        const Log log = parse_log(prefix, "x.tsv");
        ASSERT_EQ(log.trials.size(), lines - 1) << size;
        ASSERT_EQ(log.torn.has_value(), !prefix.ends_with('\n')) << size;
    }
}

} // namespace
