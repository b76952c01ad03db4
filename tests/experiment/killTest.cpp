// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <random>
#include <set>

#include <fmt/format.h>
#include <unistd.h>

#include "resume_fixture.h"

namespace {

namespace fs = std::filesystem;

class KillTest : public fixture::ResumeTest {};

/// How many sessions to kill: few by default, more by SKIN2AFC_KILLS.
int kills() {
    const char* count = std::getenv("SKIN2AFC_KILLS");
    return count ? std::atoi(count) : 15;
}

/// Lines of a log, 0 where there is none.
std::size_t lines_in(const fs::path& log) {
    const std::string text = fs::exists(log) ? fixture::read(log) : "";
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Wait until a log has so many lines, but not much longer than a session takes.
void wait_for_lines(const fs::path& log, std::size_t lines, unsigned takes_us) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::microseconds(2 * takes_us);
    while (lines_in(log) < lines && std::chrono::steady_clock::now() < end) {
        ::usleep(50);
    }
}

TEST_F(KillTest, keepsEveryAnswerOnceHoweverOftenItIsKilled) {
    fixture::write(protocol_.file,
                   fixture::read(protocol_.file) +
                       "practice = 2\n[session.texts]\nconsent = \"Will you?\"\n"
                       "[[session.questions]]\nid = \"age\"\nkind = \"integer\"\ntext = \"Age?\"\n"
                       "[[session.questions]]\nid = \"art\"\nkind = \"text\"\ntext = \"Art?\"\n");
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(fixture::run_program(arguments(folder_ / "undisturbed")).exit_code, 0);
    const auto takes_us = static_cast<unsigned>(
        std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - start)
            .count());
    const auto expected = answers(fixture::log_path(folder_ / "undisturbed", "01"));
    std::mt19937 random(7);
    std::set<std::size_t> places;
    int killed = 0;
    int study_number = 0;
    for (; killed < kills(); ++study_number) {
        const fs::path study = folder_ / fmt::format("study{}", study_number);
        const fs::path log = fixture::log_path(study, "01");
        // Kill the session again and again until one reaches its end.
        for (bool done = false; !done;) {
            const pid_t program = fixture::start_program(arguments(study), folder_.path());
            // Half of them at any time, and half when a number of answers is there: writing takes little of
            // it.
            if (random() % 2 == 0) {
                ::usleep(static_cast<useconds_t>(random() % takes_us));
            } else {
                wait_for_lines(log, random() % (expected.size() + 2), takes_us);
            }
            ::kill(program, SIGKILL);
            const bool survived = fixture::wait_for_program(program, folder_.path()).exit_code == 0;
            killed += survived ? 0 : 1;
            if (const std::size_t lines = lines_in(log); lines > 0) {
                places.insert(lines - 1);
                done = lines == expected.size() + 1;
            }
            ASSERT_TRUE(done || !survived);
            if (killed >= kills() && !done) {
                ASSERT_EQ(fixture::run_program(arguments(study)).exit_code, 0);
                done = true;
            }
        }
        ASSERT_EQ(answers(log), expected);
        ASSERT_FALSE(fs::exists(fixture::log_path(study, "01", 2)));
        // The questionnaire was answered once, and never again.
        EXPECT_EQ(fixture::lines_of(study / "participants.tsv").size(), 2U);
        EXPECT_EQ(fixture::lines_of(study / "phenotype/questionnaire.tsv").size(), 2U);
        const auto analysed =
            fixture::run_program({"analyse", study.string(), "--out",
                                  (folder_ / fmt::format("analysis{}", study_number)).string()});
        ASSERT_EQ(analysed.exit_code, 0) << analysed.err;
    }
    if (kills() >= 100) {
        // The kills came at different places, or the test has shown nothing.
        EXPECT_GT(places.size(), 10U); // of 13
    }
    fmt::print("{} kills in {} sessions, after {} numbers of answers\n", killed, study_number, places.size());
}

} // namespace
