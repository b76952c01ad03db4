// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>

#include <support/file.h>

#include "fixture.h"

namespace {

/// A small study, ready to run through the program.
class SessionCommandTest : public testing::Test {
protected:
    SessionCommandTest() : protocol_(fixture::small_protocol(folder_.path())) {
        fixture::write_stimuli(folder_ / "stimuli", protocol_);
    }

    std::vector<std::string> arguments(const std::string& label, const std::string& observer = "null") const {
        return {"session",       protocol_.file.string(),
                "--stimuli",     (folder_ / "stimuli").string(),
                "--study",       (folder_ / "study").string(),
                "--participant", label,
                "--simulate",    observer};
    }
    fixture::Outcome run(const std::string& label, const std::vector<std::string>& more = {}) const {
        auto all = arguments(label);
        all.insert(all.end(), more.begin(), more.end());
        return fixture::run_program(all);
    }
    /// Bad input: exit code 2, one line that holds `part`, and no file.
    void expect_refused(const fixture::Outcome& outcome, const std::string& part) const {
        EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_TRUE(fixture::files_below(folder_ / "study").empty());
    }

    fixture::TemporaryFolder folder_;
    study::Protocol protocol_;
};

TEST_F(SessionCommandTest, leavesAWholeStudy) {
    fixture::write(folder_ / "stimuli/contact_sheet.png", "sheet");
    const auto outcome = run("01");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const std::string copies =
        "stimuli/" + support::sha256_of_file(folder_ / "stimuli/manifest.json").substr(0, 12);
    EXPECT_EQ(fixture::files_below(folder_ / "study"),
              (std::vector<std::string>{
                  "README.md", "dataset_description.json", "participants.json", "participants.tsv",
                  copies + "/no_sss_near_000.png", copies + "/ts_near_000.png", "stimuli/contact_sheet.png",
                  "sub-01/beh/sub-01_task-skin2afc_run-01_beh.json",
                  "sub-01/beh/sub-01_task-skin2afc_run-01_beh.tsv",
                  "sub-01/beh/sub-01_task-skin2afc_run-01_events.tsv", "task-skin2afc_events.json"}));
    EXPECT_EQ(fixture::read_log(fixture::log_path(folder_ / "study", "01")).size(), 2U);
}

TEST_F(SessionCommandTest, describesTheSessionInTheSidecar) {
    run("01", {"--seed", "12"});
    const auto log = fixture::log_path(folder_ / "study", "01");
    const auto sidecar =
        nlohmann::json::parse(fixture::read(std::filesystem::path(log).replace_extension(".json")));
    EXPECT_EQ(sidecar["Seed"], 12);
    EXPECT_EQ(sidecar["TrialsPlanned"], 2);
    EXPECT_EQ(sidecar["Complete"], true);
    EXPECT_EQ(sidecar["Simulated"], true);
    EXPECT_EQ(sidecar["Observer"], "null");
    EXPECT_EQ(sidecar["Pacing"], "simulated");
    EXPECT_EQ(sidecar["Protocol"], "small");
    EXPECT_EQ(sidecar["ProtocolDigest"], protocol_.digest);
    EXPECT_EQ(sidecar["TaskName"], "skin2afc");
    EXPECT_EQ(sidecar["StimulusPresentation"]["SoftwareName"], "skin2afc");
    // BIDS: each column of the table is described under its own name.
    const auto row = fixture::read_log(log).front();
    for (const auto& [column, value] : row) {
        EXPECT_TRUE(sidecar[column]["Description"].is_string()) << column;
    }
}

TEST_F(SessionCommandTest, givesTheSameLogForTheSameSeed) {
    run("01", {"--seed", "5"});
    run("02", {"--seed", "5"});
    run("01");
    const auto study = folder_ / "study";
    EXPECT_EQ(fixture::read(fixture::log_path(study, "01")), fixture::read(fixture::log_path(study, "02")));
    EXPECT_NE(fixture::read(fixture::log_path(study, "01")),
              fixture::read(fixture::log_path(study, "01", 2)));
}

TEST_F(SessionCommandTest, refusesWrongLabels) {
    expect_refused(run("a/b"), "--participant: expected 1 to 64 letters and digits");
    expect_refused(run("../../x"), "--participant");
    expect_refused(run(""), "--participant");
    expect_refused(run(std::string(5000, 'a')), "--participant");
}

TEST_F(SessionCommandTest, refusesHalfASetOfStimuli) {
    std::filesystem::remove(folder_ / "stimuli/ts_near_000.png");
    expect_refused(run("01"), "ts_near_000.png: expected the picture of the manifest, found no such file");
    std::filesystem::remove(folder_ / "stimuli/manifest.json");
    expect_refused(run("01"), "manifest.json: no such file");
}

TEST_F(SessionCommandTest, refusesAWrongProtocolOrObserver) {
    auto words = arguments("01", (folder_ / "none.toml").string());
    expect_refused(fixture::run_program(words), "none.toml: no such file");
    const auto unpublished = fixture::small_protocol(folder_ / "unpublished", "[1]");
    words = arguments("01", "paper");
    words[1] = unpublished.file.string();
    expect_refused(fixture::run_program(words), "published counts");
    words = arguments("01");
    words[1] = (folder_ / "none.toml").string();
    expect_refused(fixture::run_program(words), "none.toml: no such file");
}

TEST_F(SessionCommandTest, refusesWrongUsage) {
    expect_refused(run("01", {"--seed", "-1"}), "--seed");
    expect_refused(run("01", {"--seed", "99999999999999999999"}), "--seed");
    expect_refused(run("01", {"--sed", "1"}), "--sed");
    expect_refused(fixture::run_program({"session"}), "required");
    for (const char* length : {"--distance-cm", "--screen-width-mm"}) {
        for (const char* value : {"nan", "inf", "0", "-1"}) {
            expect_refused(run("01", {length, value}), length);
        }
    }
    expect_refused(fixture::run_program({"session", "--timing-test", "nan"}), "--timing-test");
    expect_refused(
        fixture::run_program({"session", "--timing-test", "1", "--study", (folder_ / "study").string()}),
        "--study");
}

TEST_F(SessionCommandTest, refusesAStudyFolderThatIsAFile) {
    fixture::write(folder_ / "study", "a file");
    const auto outcome = run("01");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("study: expected a folder"), std::string::npos) << outcome.err;
    EXPECT_EQ(fixture::read(folder_ / "study"), "a file");
}

TEST_F(SessionCommandTest, needsADisplayUnlessSimulated) {
    const char* display = std::getenv("DISPLAY");
    const std::string before = display ? display : "";
    ::unsetenv("DISPLAY");
    auto words = arguments("01");
    words.resize(words.size() - 2);
    const auto outcome = fixture::run_program(words);
    if (display) {
        ::setenv("DISPLAY", before.c_str(), 1);
    }
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("a session needs a display"), std::string::npos) << outcome.err;
    EXPECT_TRUE(fixture::files_below(folder_ / "study").empty());
}

} // namespace
