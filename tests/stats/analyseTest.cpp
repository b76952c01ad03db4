// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/command.h>

#include <algorithm>
#include <cstdlib>

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <support/error.h>

#include "figure8.h"
#include "forest.h"
#include "study_folder.h"

namespace {

/// What "skin2afc analyse ARGUMENTS" prints.
std::string analyse(std::vector<std::string> arguments) {
    CLI::App app("test");
    stats::add_command(app);
    testing::internal::CaptureStdout();
    try {
        arguments.insert(arguments.begin(), "analyse");
        std::reverse(arguments.begin(), arguments.end()); // as CLI11 takes them
        app.parse(arguments);
    } catch (...) {
        testing::internal::GetCapturedStdout();
        throw;
    }
    return testing::internal::GetCapturedStdout();
}

std::string analyse(const fs::path& study, const fs::path& out) {
    return analyse({study.string(), "--out", out.string()});
}

std::size_t files_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(AnalyseTest, writesItsFilesAndNothingElse) {
    const StudyFolder folder;
    folder.write_published_logs();
    const fs::path out = folder.path() / "a" / "b";
    const std::string text = analyse(folder.path(), out);
    EXPECT_NE(text.find("TS - Zoom - 110\u00b0"), std::string::npos);
    EXPECT_EQ(text.find("SIMULATED"), std::string::npos);
    EXPECT_EQ(files_in(out), 10u);
    EXPECT_NE(read_file(out / "report.html").find("</html>"), std::string::npos);

    const auto summary = nlohmann::json::parse(read_file(out / "summary.json"));
    EXPECT_EQ(summary["simulated"], false);
    EXPECT_EQ(summary["participants"].size(), 16u);
    EXPECT_EQ(summary["trials"], 16 * 72);
    EXPECT_EQ(summary["conditions"].size(), 36u);
    EXPECT_EQ(summary["significant"]["raw"], 25);
    EXPECT_EQ(summary["conditions"][35]["chi_square"],
              0.5); // ss_full, zoom, 150 degrees [Jimenez2009, Table II]
}

TEST(AnalyseTest, theSummaryTellsWhatWasLeftOut) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rn") + "3\t");
    folder.write_log("01", log_text("r"), "_run-02");
    analyse(folder.path(), folder.path() / "out");
    const auto summary = nlohmann::json::parse(read_file(folder.path() / "out" / "summary.json"));
    EXPECT_EQ(summary["unanswered"], 1);
    EXPECT_EQ(summary["runs_used"][0]["file"], "sub-01/beh/sub-01_task-skin2afc_beh.tsv");
    EXPECT_EQ(summary["runs_left_out"][0]["why"], "incomplete, 1 of 2 trials; run 1 counts");
    EXPECT_EQ(summary["lines_set_aside"][0]["line"], 4);
}

TEST(AnalyseTest, simulatedDataSaySoInEveryOutput) {
    const StudyFolder folder;
    folder.write_published_logs();
    folder.write("dataset_description.json", R"({"Name": "S", "Simulated": true})");
    const fs::path out = folder.path() / "out";
    EXPECT_TRUE(analyse(folder.path(), out).starts_with("SIMULATED DATA"));
    EXPECT_NE(read_file(out / "figure8.svg").find("SIMULATED DATA"), std::string::npos);
    EXPECT_NE(read_file(out / "report.html").find("class=\"banner\""), std::string::npos);
    EXPECT_NE(read_file(out / "table2.tsv").find("\ttrue\t"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(read_file(out / "summary.json"))["simulated"], true);
}

TEST(AnalyseTest, badInputWritesNothing) {
    const StudyFolder folder;
    const fs::path out = folder.path() / "out";
    EXPECT_THROW(analyse(folder.path() / "missing", out), support::InputError);
    EXPECT_THROW(analyse(folder.path(), out), support::InputError);
    folder.write_log("01", log_text("r"));
    folder.write("stimuli/contact_sheet.png", "no picture");
    EXPECT_THROW(analyse(folder.path(), out), support::InputError);
    EXPECT_FALSE(fs::exists(out));
}

TEST(AnalyseTest, aFileInTheFoldersPlaceIsRefused) {
    const StudyFolder folder;
    folder.write_log("01", log_text("r"));
    EXPECT_THROW(analyse(folder.path(), folder.write("out", "mine")), support::InputError);
    EXPECT_EQ(read_file(folder.path() / "out"), "mine");
}

TEST(AnalyseTest, aFolderInAFilesPlaceIsRefusedBeforeAnythingIsWritten) {
    const StudyFolder folder;
    folder.write_log("01", log_text("r"));
    const fs::path out = folder.path() / "out";
    fs::create_directories(out / "table2.tsv");
    EXPECT_THROW(analyse(folder.path(), out), support::InputError);
    EXPECT_EQ(files_in(out), 1u);
}

TEST(AnalyseTest, aMissingGnuplotIsOneClearFailure) {
    const StudyFolder folder;
    folder.write_log("01", log_text("r"));
    const std::string path = std::getenv("PATH");
    ::setenv("PATH", folder.path().c_str(), 1);
    const std::string message =
        message_of<support::Failure>([&] { analyse(folder.path(), folder.path() / "out"); });
    ::setenv("PATH", path.c_str(), 1);
    EXPECT_NE(message.find("gnuplot: expected the program on PATH"), std::string::npos) << message;
    EXPECT_FALSE(fs::exists(folder.path() / "out"));
}

TEST(AnalyseTest, figureShowsEveryShaderAndPlace) {
    const StudyFolder folder;
    folder.write_published_logs();
    const std::string svg = stats::figure8(make_table(stats::read_study(folder.path())), "");
    for (const char* part : {"No SSS", "SS Jittered", "SS Full", "0\u00b0", "150\u00b0", "Far", "Near",
                             "Zoom", "Proportion choosing TS", "pooled Wilson 95 %"}) {
        EXPECT_NE(svg.find(part), std::string::npos) << part;
    }
    // 3 shaders at 4 azimuths and 3 distances, and 3 in the legend; each marker has its shape's number.
    for (const char* marker : {"'#gpPt4' transform", "'#gpPt6' transform", "'#gpPt8' transform"}) {
        std::size_t count = 0;
        for (auto at = svg.find(marker); at != std::string::npos; at = svg.find(marker, at + 1)) {
            ++count;
        }
        EXPECT_GE(count, 8u) << marker;
    }
}

TEST(AnalyseTest, forestsShowEveryRow) {
    const StudyFolder folder;
    folder.write_published_logs();
    const auto analysis = stats::analyse_study(folder.path());
    const std::string shaders = forest_of_shaders(analysis, "SIMULATED DATA"),
                      conditions = forest_of_conditions(analysis, "");
    EXPECT_NE(shaders.find("SIMULATED DATA"), std::string::npos);
    for (const std::string& svg : {shaders, conditions}) {
        // 8 groups or 12 conditions of each of three shaders, each with its marker.
        for (const char* part : {"No SSS against TS", "SS Jittered against TS", "SS Full against TS",
                                 "'#gpPt4' transform", "'#gpPt6' transform", "'#gpPt8' transform"}) {
            EXPECT_NE(svg.find(part), std::string::npos) << part;
        }
    }
    EXPECT_NE(conditions.find("Zoom - 150\u00b0"), std::string::npos);
}

TEST(AnalyseTest, badFilesAreLeftOutOnRequestAndListed) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rt"));
    folder.write_log("02", "trial,reference\n");
    const fs::path out = folder.path() / "out";
    EXPECT_THROW(analyse(folder.path(), out), support::InputError);
    EXPECT_FALSE(fs::exists(out));
    const std::string text = analyse({folder.path().string(), "--out", out.string(), "--skip-bad"});
    EXPECT_NE(text.find("bad files 1"), std::string::npos) << text;
    const auto summary = nlohmann::json::parse(read_file(out / "summary.json"));
    EXPECT_EQ(summary["bad_files"][0]["file"], "sub-02/beh/sub-02_task-skin2afc_beh.tsv");
}

TEST(AnalyseTest, boundsAreTheUsers) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rtrtrt"));
    const fs::path out = folder.path() / "out";
    analyse({folder.path().string(), "--out", out.string(), "--bounds", "0.2,0.9"});
    const auto summary = nlohmann::json::parse(read_file(out / "summary.json"));
    EXPECT_EQ(summary["settings"]["equivalence_high"], 0.9);
    EXPECT_EQ(summary["shaders"][0]["p_equivalence"], stats::equivalence_p(3, 6, {0.2, 0.9}));
    EXPECT_NE(read_file(out / "report.html").find("bounds of 0.2 and 0.9"), std::string::npos);
    EXPECT_THROW(analyse({folder.path().string(), "--out", out.string(), "--bounds", "0.6,0.4"}),
                 support::InputError);
    EXPECT_THROW(analyse({folder.path().string(), "--out", out.string(), "--bounds", "0,1"}),
                 CLI::ValidationError);
    // Bounds that leave out half and half would call a preference no preference.
    for (const char* bounds : {"0.6,0.9", "0.1,0.4", "0.5,0.6"}) {
        EXPECT_THROW(analyse({folder.path().string(), "--out", out.string(), "--bounds", bounds}),
                     support::InputError)
            << bounds;
    }
}

TEST(AnalyseTest, powerNeedsNoLogs) {
    const StudyFolder folder;
    const fs::path out = folder.path() / "out";
    const std::string text =
        analyse({"--power", "--studies", "100", "--spread", "0.5", "--out", out.string()});
    EXPECT_NE(text.find("Exact, for independent answers"), std::string::npos);
    EXPECT_EQ(files_in(out), 2u);
    EXPECT_TRUE(read_file(out / "power.tsv").starts_with("participants\ttrials\tproportion\tspread\tpower"));
}

TEST(AnalyseTest, optionsThatWouldBeIgnoredAreRefused) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rt"));
    const std::string study = folder.path().string(), out = (folder.path() / "out").string();
    EXPECT_EQ(message_of<support::InputError>([&] {
                  analyse({study, "--power"});
              }),
              "STUDY: expected not to be given with --power, which reads no logs");
    for (const std::vector<std::string>& option : std::vector<std::vector<std::string>>{
             {"--bounds", "0.4,0.6"}, {"--stimuli", study}, {"--skip-bad"}, {"--mixed-protocols"}}) {
        std::vector<std::string> arguments{"--power", "--studies", "100"};
        arguments.insert(arguments.end(), option.begin(), option.end());
        EXPECT_EQ(message_of<support::InputError>([&] { analyse(arguments); }),
                  option[0] + ": expected not to be given with --power, which reads no logs");
    }
    for (const auto& [option, value] : {std::pair("--participants", "24"),
                                        {"--trials", "24"},
                                        {"--proportion", "0.6"},
                                        {"--spread", "0.5"},
                                        {"--studies", "200"}}) {
        EXPECT_EQ(message_of<support::InputError>([&] {
                      analyse({study, "--out", out, option, value});
                  }),
                  std::string(option) + ": expected with --power only, found without it");
    }
    EXPECT_FALSE(fs::exists(out));
}

TEST(AnalyseTest, whatIsNotANumberIsRefused) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rt"));
    const std::string study = folder.path().string(), out = (folder.path() / "out").string();
    for (const char* value : {"nan", "-nan", "NAN", "inf", "-inf", "1e999", "x"}) {
        EXPECT_THROW(analyse({study, "--out", out, "--bounds", std::string(value) + ",0.6"}), CLI::ParseError)
            << value;
        EXPECT_THROW(analyse({study, "--out", out, "--bounds", "0.4," + std::string(value)}), CLI::ParseError)
            << value;
        for (const char* option :
             {"--spread", "--proportion", "--participants", "--trials", "--studies", "--seed"}) {
            EXPECT_THROW(analyse({"--power", option, value, "--out", out}), CLI::ParseError)
                << option << " " << value;
        }
    }
    EXPECT_THROW(analyse({"--power", "--seed=-1", "--out", out}), CLI::ParseError);
    EXPECT_EQ(message_of<CLI::ParseError>([&] {
                  analyse({"--power", "--spread", "0.5,nan"});
              }),
              "--spread: Value nan not in range 0 to 5");
    EXPECT_FALSE(fs::exists(out));
}

TEST(AnalyseTest, stimuliThatAreNotThereAreRefused) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rt"));
    const fs::path out = folder.path() / "out", empty = folder.path() / "empty";
    fs::create_directories(empty);
    const auto message = [&](const fs::path& stimuli) {
        return message_of<support::InputError>([&] {
            analyse({folder.path().string(), "--out", out.string(), "--stimuli", stimuli.string()});
        });
    };
    EXPECT_EQ(message(folder.path() / "none"), "--stimuli: " + (folder.path() / "none").string() +
                                                   ": expected a folder of stimuli, found nothing");
    EXPECT_TRUE(message(folder.write("file", "")).ends_with("expected a folder of stimuli, found a file"));
    EXPECT_TRUE(
        message(empty).starts_with("--stimuli: " + empty.string() + ": expected pictures of the study's"));
    EXPECT_FALSE(fs::exists(out));
}

TEST(AnalyseTest, incompleteRunsAreTold) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rtrt"));
    folder.write_log("02", log_text("r"));
    EXPECT_NE(analyse(folder.path(), folder.path() / "out").find("sub-02 counts with 1 of 4 trials"),
              std::string::npos);
}

TEST(AnalyseTest, helpFitsAPage) {
    CLI::App app("test");
    stats::add_command(app);
    EXPECT_LT(app.get_subcommand("analyse")->help().size(), 4096u);
}

TEST(AnalyseTest, studyAndOutAreRequiredOtherwise) {
    EXPECT_THROW(analyse({"--out", "x"}), CLI::RequiredError);
    EXPECT_THROW(analyse({"x"}), CLI::RequiredError);
}

TEST(AnalyseTest, oneAnswerIsEnough) {
    const StudyFolder folder;
    folder.write_log("01", log_text("r"));
    const fs::path out = folder.path() / "out";
    const std::string text = analyse(folder.path(), out);
    EXPECT_NE(text.find("cannot be tested: with 1 participant,"), std::string::npos);
    const auto row = nlohmann::json::parse(read_file(out / "summary.json"))["shaders"][0];
    EXPECT_EQ(row["p_sign_flip"], 1);
    EXPECT_EQ(row["mixed_intercept"], nullptr);
    EXPECT_EQ(row["d_prime"], "inf");
}

} // namespace
