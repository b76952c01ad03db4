// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <csignal>
#include <set>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <support/error.h>

#include "fixture.h"
#include "interruption.h"
#include "log/folder_lock.h"
#include "log/study_folder.h"
#include "stage.h"

namespace {

using experiment::check_label;
using experiment::StudyFolder;

TEST(LabelTest, isLettersAndDigits) {
    for (const char* label : {"1", "01", "A9z"}) {
        EXPECT_NO_THROW(check_label(label)) << label;
    }
    EXPECT_NO_THROW(check_label(std::string(64, 'a')));
    for (const char* label : {"", "a/b", "../x", ".", "sub-01", "a b", "a\n", "\xc3\xa4", "a+b", "-"}) {
        EXPECT_THROW(check_label(label), support::InputError) << label;
    }
    EXPECT_THROW(check_label(std::string(65, 'a')), support::InputError);
    EXPECT_THROW(check_label(std::string("a\0b", 3)), support::InputError);
}

TEST(StudyFolderTest, notesEachParticipantOnce) {
    const fixture::TemporaryFolder folder;
    const StudyFolder study(folder / "study", false, "paper");
    study.prepare("A study", "02");
    study.prepare("A study", "01");
    study.prepare("A study", "02");
    EXPECT_EQ(fixture::read(folder / "study/participants.tsv"), "participant_id\nsub-02\nsub-01\n");
}

TEST(StudyFolderTest, keepsWhatOthersWroteAboutParticipants) {
    const fixture::TemporaryFolder folder;
    fixture::write(folder / "participants.tsv", "participant_id\tage\tsex\r\nsub-9\t30\tf");
    StudyFolder(folder.path(), false, "paper").prepare("A study", "01");
    EXPECT_EQ(fixture::read(folder / "participants.tsv"),
              "participant_id\tage\tsex\nsub-9\t30\tf\nsub-01\tn/a\tn/a\n");
}

TEST(StudyFolderTest, refusesAForeignParticipantsTable) {
    const fixture::TemporaryFolder folder;
    fixture::write(folder / "participants.tsv", "name\nx\n");
    EXPECT_THROW(StudyFolder(folder.path(), false, "paper").prepare("A study", "01"), support::InputError);
    EXPECT_EQ(fixture::read(folder / "participants.tsv"), "name\nx\n");
}

TEST(StudyFolderTest, notesEachParticipantOnceForProgramsAtOnce) {
    const fixture::TemporaryFolder folder;
    constexpr int programs = 8;
    constexpr int participants = 40;
    for (int i = 0; i < programs; ++i) {
        if (::fork() == 0) {
            for (int label = 0; label < participants; ++label) {
                StudyFolder(folder.path(), true, "paper").prepare("A study", std::to_string(label));
            }
            ::_exit(0);
        }
    }
    for (int i = 0; i < programs; ++i) {
        int status = 1;
        ::wait(&status);
        EXPECT_EQ(status, 0);
    }
    const auto lines = fixture::lines_of(folder / "participants.tsv");
    EXPECT_EQ(lines.size(), participants + 1U);
    EXPECT_EQ(std::set(lines.begin(), lines.end()).size(), participants + 1U);
}

TEST(StudyFolderTest, waitsForTheProgramThatHoldsTheParticipants) {
    const fixture::TemporaryFolder folder;
    fixture::write(folder / "participants.tsv", "participant_id\n");
    const int held = ::open(folder.path().c_str(), O_RDONLY);
    ASSERT_EQ(::flock(held, LOCK_EX), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        ::close(held);
        bool told = false; // so short a wait is no one's concern
        StudyFolder(folder.path(), true, "paper").prepare("A study", "01", [&] { told = true; });
        ::_exit(told ? 1 : 0);
    }
    ::usleep(200000); // a hundred times what it takes
    EXPECT_EQ(fixture::read(folder / "participants.tsv"), "participant_id\n");
    ::close(held);
    int status = 1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(fixture::read(folder / "participants.tsv"), "participant_id\nsub-01\n");
}

TEST(StudyFolderTest, tellsWhoWaitsLongAndGivesUp) {
    const fixture::TemporaryFolder folder;
    const int held = ::open(folder.path().c_str(), O_RDONLY);
    ASSERT_EQ(::flock(held, LOCK_EX), 0);
    int told = 0;
    EXPECT_THROW(StudyFolder(folder.path(), true, "paper").prepare("A study", "01", [&] { ++told; }),
                 support::Failure);
    EXPECT_EQ(told, 1);
    EXPECT_TRUE(fixture::files_below(folder.path()).empty());
    // Who waits can be asked to end.
    const experiment::Interruption interruption;
    std::raise(SIGTERM);
    EXPECT_THROW(experiment::FolderLock::wait(folder.path()), experiment::Interrupted);
    ::close(held);
}

TEST(FolderLockTest, isSharedByManyOrHeldByOne) {
    const fixture::TemporaryFolder folder;
    {
        const auto one = experiment::FolderLock::share(folder.path());
        const auto other = experiment::FolderLock::share(folder.path());
        EXPECT_FALSE(experiment::FolderLock::attempt(folder.path()));
    }
    EXPECT_TRUE(experiment::FolderLock::attempt(folder.path()));
}

TEST(StudyFolderTest, tellsReadersWhatItHoldsWhereNoOneHas) {
    const fixture::TemporaryFolder folder;
    StudyFolder(folder / "real", false, "paper").prepare("Faces of 2009", "01");
    StudyFolder(folder / "simulated", true, "paper").prepare("Faces of 2009", "01");
    const std::string real = fixture::read(folder / "real/README.md");
    EXPECT_EQ(real.rfind("# Faces of 2009\n", 0), 0U) << real;
    EXPECT_EQ(real.find("Simulated"), std::string::npos);
    EXPECT_NE(fixture::read(folder / "simulated/README.md").find("no person took part"), std::string::npos);
    // Each name that BIDS has for it, and the program's own text once it was edited.
    for (const char* name : {"README", "README.md", "README.rst", "README.txt"}) {
        fixture::write(folder / name / name, "ours");
        StudyFolder(folder / name, false, "paper").prepare("Faces of 2009", "01");
        EXPECT_EQ(fixture::read(folder / name / name), "ours");
        const auto files = fixture::files_below(folder / name);
        EXPECT_EQ(std::count_if(files.begin(), files.end(),
                                [](const std::string& file) { return file.starts_with("README"); }),
                  1);
    }
}

TEST(StudyFolderTest, saysWhetherItsParticipantsAreSimulated) {
    const fixture::TemporaryFolder folder;
    StudyFolder(folder / "real", false, "paper").prepare("A study", "01");
    StudyFolder(folder / "simulated", true, "paper").prepare("A study", "01");
    const auto real = nlohmann::json::parse(fixture::read(folder / "real/dataset_description.json"));
    const auto simulated =
        nlohmann::json::parse(fixture::read(folder / "simulated/dataset_description.json"));
    EXPECT_EQ(real["Simulated"], false);
    EXPECT_EQ(simulated["Simulated"], true);
    // BIDS 1.11, Dataset description: required fields.
    for (const auto& description : {real, simulated}) {
        EXPECT_TRUE(description["Name"].is_string());
        EXPECT_EQ(description["BIDSVersion"].get<std::string>().substr(0, 5), "1.11.");
        EXPECT_EQ(description["DatasetType"], "raw");
    }
}

TEST(StudyFolderTest, keepsSimulatedAndRealParticipantsApart) {
    const fixture::TemporaryFolder folder;
    StudyFolder(folder / "real", false, "paper").prepare("A study", "01");
    StudyFolder(folder / "simulated", true, "paper").prepare("A study", "01");
    EXPECT_THROW(StudyFolder(folder / "real", true, "paper"), support::InputError);
    EXPECT_THROW(StudyFolder(folder / "simulated", false, "paper"), support::InputError);
    EXPECT_NO_THROW(StudyFolder(folder / "real", false, "paper"));
    EXPECT_NO_THROW(StudyFolder(folder / "simulated", true, "paper"));

    // Data that say nothing are real.
    fixture::write(folder / "silent/sub-01/beh/x.tsv", "x");
    EXPECT_THROW(StudyFolder(folder / "silent", true, "paper"), support::InputError);
    fixture::write(folder / "described/dataset_description.json", "{\"Name\": \"x\"}");
    EXPECT_THROW(StudyFolder(folder / "described", true, "paper"), support::InputError);
}

TEST(StudyFolderTest, keepsProtocolsApart) {
    const fixture::TemporaryFolder folder;
    StudyFolder(folder / "study", false, "paper").prepare("A study", "01");
    EXPECT_NO_THROW(StudyFolder(folder / "study", false, "paper"));
    EXPECT_THROW(StudyFolder(folder / "study", false, "another"), support::InputError);
}

TEST(StudyFolderTest, refusesADescriptionThatItCannotRead) {
    const fixture::TemporaryFolder folder;
    for (const char* text : {"", "{", "[]", "{\"Simulated\": \"yes\"}"}) {
        fixture::write(folder / "dataset_description.json", text);
        EXPECT_THROW(StudyFolder(folder.path(), true, "paper"), support::InputError) << text;
        EXPECT_THROW(StudyFolder(folder.path(), false, "paper"), support::InputError) << text;
    }
}

TEST(StudyCopyTest, bringsBackTheStudysOwnFilesAndLeavesOthers) {
    const fixture::TemporaryFolder folder;
    const StudyFolder study(folder / "study", true, "paper");
    study.prepare("Title", "01");
    fixture::write(folder / "study/phenotype/questionnaire.tsv", "participant_id\tart\nsub-01\tnone\n");
    const auto files = fixture::files_below(folder / "study");
    std::vector<std::string> contents;
    for (const std::string& file : files) {
        contents.push_back(fixture::read(folder / "study" / file));
    }
    const experiment::StudyCopy copy(folder / "study");
    std::filesystem::remove_all(folder / "study");
    fixture::write(folder / "study/participants.tsv", "participant_id\nsub-02\n"); // another's, meanwhile
    copy.restore();
    for (std::size_t i = 0; i < files.size(); ++i) {
        const std::string now = fixture::read(folder / "study" / files[i]);
        EXPECT_EQ(now, files[i] == "participants.tsv" ? "participant_id\nsub-02\n" : contents[i]) << files[i];
    }
    // It still says that its participants are simulated.
    EXPECT_THROW(StudyFolder(folder / "study", false, "paper"), support::InputError);
}

TEST(StudyFolderTest, keepsTheFirstContactSheet) {
    const fixture::TemporaryFolder folder;
    const StudyFolder study(folder / "study", false, "paper");
    study.keep_contact_sheet(folder / "missing.png");
    EXPECT_TRUE(fixture::files_below(folder / "study").empty());
    fixture::write(folder / "one.png", "one");
    fixture::write(folder / "two.png", "two");
    study.keep_contact_sheet(folder / "one.png");
    study.keep_contact_sheet(folder / "two.png");
    EXPECT_EQ(fixture::read(folder / "study/stimuli/contact_sheet.png"), "one");
    EXPECT_EQ(fixture::files_below(folder / "study").size(), 1U);
}

} // namespace
