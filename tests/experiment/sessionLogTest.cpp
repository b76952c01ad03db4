// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <csignal>
#include <cstdlib>
#include <set>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <support/error.h>

#include "fixture.h"
#include "log/session_log.h"
#include "procedure.h"
#include "simulated_stage.h"

namespace {

using experiment::Answer;
using experiment::SessionLog;

const Answer example{.trial = {"ts", "ss_full", "zoom", 110, "ss_full", "ts"},
                     .response = 2,
                     .response_time_s = 1.25,
                     .onset_first_s = 10,
                     .onset_grey_s = 12.5,
                     .onset_second_s = 14.5};

// The columns of the file format, in its order.
constexpr const char* columns =
    "trial\treference\ttest\tdistance\tazimuth_deg\tfirst\tsecond\tresponse\tchosen\t"
    "response_time\tonset_first\tonset_grey\tonset_second";

TEST(SessionLogTest, hasTheColumnsOfTheFileFormat) {
    const fixture::TemporaryFolder study;
    SessionLog log = SessionLog::create(study.path(), "01");
    log.append(example);
    EXPECT_EQ(log.path(), study / "sub-01/beh/sub-01_task-skin2afc_run-01_beh.tsv");
    EXPECT_EQ(fixture::read(log.path()),
              std::string(columns) + "\n1\tts\tss_full\tzoom\t110\tss_full\tts\t2\tts\t1.250000\t10.000000\t"
                                     "12.500000\t14.500000\n");
}

TEST(SessionLogTest, givesEachRunANumberOfItsOwnAfterTheLast) {
    const fixture::TemporaryFolder study;
    EXPECT_EQ(SessionLog::create(study.path(), "01").path(), fixture::log_path(study.path(), "01", 1));
    EXPECT_EQ(SessionLog::create(study.path(), "01").path(), fixture::log_path(study.path(), "01", 2));
    fixture::write(fixture::log_path(study.path(), "01", 7).replace_extension(".json"), "{}");
    EXPECT_EQ(SessionLog::create(study.path(), "01").path(), fixture::log_path(study.path(), "01", 8));
    EXPECT_EQ(SessionLog::create(study.path(), "02").path(), fixture::log_path(study.path(), "02", 1));
}

TEST(SessionLogTest, neverTouchesAnEarlierRun) {
    const fixture::TemporaryFolder study;
    fixture::write(fixture::log_path(study.path(), "01"), "precious");
    SessionLog log = SessionLog::create(study.path(), "01");
    log.append(example);
    EXPECT_EQ(fixture::read(fixture::log_path(study.path(), "01")), "precious");
}

TEST(SessionLogTest, givesTwoProgramsAtOnceTwoRuns) {
    const fixture::TemporaryFolder study;
    constexpr int programs = 8;
    constexpr int runs_each = 10;
    for (int i = 0; i < programs; ++i) {
        if (::fork() == 0) {
            for (int run = 0; run < runs_each; ++run) {
                SessionLog::create(study.path(), "01").append(example);
            }
            ::_exit(0);
        }
    }
    for (int i = 0; i < programs; ++i) {
        int status = 1;
        ::wait(&status);
        EXPECT_EQ(status, 0);
    }
    const auto files = fixture::files_below(study.path());
    EXPECT_EQ(files.size(), static_cast<std::size_t>(programs * runs_each));
    for (const std::string& file : files) {
        EXPECT_EQ(fixture::lines_of(study / file).size(), 2U) << file;
    }
}

TEST(SessionLogTest, saysSoWhenItsFileIsDeleted) {
    const fixture::TemporaryFolder study;
    SessionLog log = SessionLog::create(study.path(), "01");
    std::filesystem::remove(log.path());
    EXPECT_THROW(log.append(example), support::Failure);
}

/// A simulated stage that tells a pipe how many answers are on the disk whenever something is shown.
class ReportingStage : public experiment::SimulatedStage {
public:
    ReportingStage(const experiment::Observer& observer, const SessionLog& log, int pipe)
        : SimulatedStage(observer, 1), log_(log), pipe_(pipe) {}
    double show_after(double duration_s, const experiment::Picture& picture) override {
        const auto answers = static_cast<unsigned char>(log_.answers());
        if (::write(pipe_, &answers, 1) != 1) {
            ::_exit(2);
        }
        return SimulatedStage::show_after(duration_s, picture);
    }

private:
    const SessionLog& log_;
    int pipe_;
};

/// Run one session in a child, kill it soon after so many reports; returns the answers that it reported as
/// saved.
std::size_t reported_before_kill(const study::Protocol& protocol, const std::filesystem::path& study,
                                 int after_reports) {
    int pipe_ends[2];
    EXPECT_EQ(::pipe(pipe_ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        SessionLog log = SessionLog::create(study, "01");
        ReportingStage stage(experiment::Observer("paper", protocol), log, pipe_ends[1]);
        const auto schedule = experiment::make_schedule(protocol, 1);
        experiment::run_trials({.session = protocol.session, .schedule = schedule}, stage, log);
        ::_exit(0);
    }
    ::close(pipe_ends[1]);
    unsigned char reported = 0;
    unsigned char last = 0;
    // By reports, not by time: however slow the machine, kills come at different places.
    for (int i = 0; i < after_reports && ::read(pipe_ends[0], &reported, 1) == 1; ++i) {
        last = reported;
    }
    ::usleep(static_cast<useconds_t>(std::rand() % 500));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    while (::read(pipe_ends[0], &reported, 1) == 1) {
        last = reported;
    }
    ::close(pipe_ends[0]);
    return last;
}

TEST(SessionLogTest, losesNoAnswerThatWasFollowedByAPictureWhenKilled) {
    const fixture::TemporaryFolder folder;
    const auto protocol = study::read_protocol(SKIN2AFC_PROTOCOLS "/jimenez2009.toml");
    std::srand(2009);
    std::set<std::size_t> lengths;
    for (int kill = 0; kill < 60; ++kill) {
        const auto study = folder / std::to_string(kill);
        const std::size_t reported = reported_before_kill(protocol, study, std::rand() % 60);
        const auto path = fixture::log_path(study, "01");
        if (!std::filesystem::exists(path)) {
            EXPECT_EQ(reported, 0U);
            continue;
        }
        // A log is never without header. Every row that was reported is whole; at most one more is there,
        // which was saved but not reported, or torn: a kill can end a write between two pages of memory.
        const std::string text = fixture::read(path);
        EXPECT_EQ(text.substr(0, text.find('\n')), columns);
        auto rows = fixture::read_log(path);
        if (text.back() != '\n') {
            rows.pop_back();
        }
        EXPECT_GE(rows.size(), reported);
        EXPECT_LE(rows.size(), reported + 1);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            EXPECT_EQ(rows[i].size(), 13U);
            EXPECT_EQ(rows[i].at("trial"), std::to_string(i + 1));
        }
        lengths.insert(rows.size());
    }
    // The kills came at different places, or the test has shown nothing.
    EXPECT_GT(lengths.size(), 5U);
}

} // namespace
