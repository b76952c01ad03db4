// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <csignal>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/fs.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <support/error.h>

#include "log/durable_file.h"
#include "resume_fixture.h"

namespace {

namespace fs = std::filesystem;
using experiment::DurableFile;
using fixture::ResumeTest;

/// A file that takes appended text and cannot be shortened while this lives; root alone can make one, where
/// the file system knows of such.
class AppendOnly {
public:
    explicit AppendOnly(const fs::path& file) : fd_(::open(file.c_str(), O_RDONLY | O_CLOEXEC)) {
        made_ = ::ioctl(fd_, FS_IOC_GETFLAGS, &before_) == 0 && set(before_ | FS_APPEND_FL);
    }
    ~AppendOnly() {
        if (made_) {
            set(before_);
        }
        ::close(fd_);
    }
    AppendOnly(const AppendOnly&) = delete;
    AppendOnly& operator=(const AppendOnly&) = delete;
    bool made() const { return made_; }

private:
    bool set(int flags) const { return ::ioctl(fd_, FS_IOC_SETFLAGS, &flags) == 0; }
    int fd_, before_ = 0;
    bool made_ = false;
};

/// No file of this program grows beyond so many bytes while this lives.
class SizeLimit {
public:
    explicit SizeLimit(rlim_t bytes) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        signal_ = std::signal(SIGXFSZ, SIG_IGN); // so that writing fails instead
    }
    ~SizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, signal_);
    }
    SizeLimit(const SizeLimit&) = delete;
    SizeLimit& operator=(const SizeLimit&) = delete;

private:
    rlimit before_{};
    void (*signal_)(int) = nullptr;
};

std::string failure_of(DurableFile& file, std::string_view text) {
    try {
        file.append(text);
    } catch (const support::Failure& failure) {
        return failure.what();
    }
    return {};
}

TEST(DurableFileTest, takesBackWhatWasWrittenInPart) {
    const fixture::TemporaryFolder folder;
    const fs::path path = folder / "log";
    auto file = DurableFile::create(path, "one\n");
    {
        const SizeLimit limit(6);
        const std::string reason = failure_of(*file, "two\n");
        EXPECT_NE(reason.find("log: cannot be written: File too large"), std::string::npos) << reason;
        EXPECT_EQ(reason.find("torn"), std::string::npos) << reason;
    }
    EXPECT_EQ(fixture::read(path), "one\n");
    EXPECT_EQ(failure_of(*file, "two\n"), "");
    EXPECT_EQ(fixture::read(path), "one\ntwo\n");
}

TEST(DurableFileTest, saysThatALineIsTornWhichCannotBeTakenBackAndDoesSoLater) {
    const fixture::TemporaryFolder folder;
    const fs::path path = folder / "log";
    auto file = DurableFile::create(path, "one\n");
    {
        const AppendOnly append_only(path);
        if (!append_only.made()) {
            GTEST_SKIP() << "only root can make an append-only file, on some file systems";
        }
        {
            const SizeLimit limit(6);
            const std::string reason = failure_of(*file, "two\n");
            EXPECT_NE(reason.find("File too large; its last line may be torn"), std::string::npos) << reason;
        }
        EXPECT_EQ(fixture::read(path), "one\ntw");
        // As long as the torn line is there, nothing comes after it.
        const std::string reason = failure_of(*file, "two\n");
        EXPECT_NE(reason.find("Operation not permitted"), std::string::npos) << reason;
        EXPECT_EQ(fixture::read(path), "one\ntw");
    }
    EXPECT_EQ(failure_of(*file, "two\n"), "");
    EXPECT_EQ(fixture::read(path), "one\ntwo\n");
}

TEST_F(ResumeTest, goesOnAfterATornLineOnlyWhenItCouldBeTakenOff) {
    cut_off_after(3, "4\tts\tno_s");
    const std::string torn = fixture::read(log());
    {
        const AppendOnly append_only(log());
        if (!append_only.made()) {
            GTEST_SKIP() << "only root can make an append-only file, on some file systems";
        }
        const auto outcome = run();
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_NE(outcome.err.find("cannot be written: Operation not permitted"), std::string::npos)
            << outcome.err;
        EXPECT_EQ(fixture::read(log()), torn);
    }
    EXPECT_EQ(run().exit_code, 0);
    EXPECT_EQ(fixture::read_log(log()).size(), 12U);
    EXPECT_EQ(fixture::read(log()).find("no_s\n"), std::string::npos);
    // It is set aside each time that it was found.
    for (const auto& line : facts()["SetAside"]) {
        EXPECT_EQ(line, "4\tts\tno_s");
    }
    EXPECT_FALSE(facts()["SetAside"].empty());
}

} // namespace
