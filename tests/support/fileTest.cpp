// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <support/error.h>
#include <support/file.h>

namespace {

namespace fs = std::filesystem;

class FileTest : public testing::Test {
protected:
    FileTest() {
        std::string name = (fs::temp_directory_path() / "skin2afc-test-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
    }
    ~FileTest() override { fs::remove_all(folder_); }

    fs::path with(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }
    std::size_t files() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

    fs::path folder_;
};

TEST_F(FileTest, readsBytesAsTheyAre) {
    const std::string bytes("a\0\r\n\xff", 5);
    EXPECT_EQ(support::read_text(with("a", bytes)), bytes);
    EXPECT_EQ(support::read_bytes(folder_ / "a").size(), 5U);
    EXPECT_EQ(support::read_text(with("empty", "")), "");
}

TEST_F(FileTest, refusesWhatIsNoPlainReadableFile) {
    EXPECT_THROW(support::read_text(folder_ / "missing"), support::InputError);
    EXPECT_THROW(support::read_text(folder_), support::InputError);
    EXPECT_THROW(support::read_bytes(with("long", "12345"), 4), support::InputError);
    EXPECT_NO_THROW(support::read_bytes(folder_ / "long", 5));
    ::mkfifo((folder_ / "pipe").c_str(), 0600);
    EXPECT_THROW(support::read_text(folder_ / "pipe"), support::InputError); // and does not wait for it
    EXPECT_THROW(support::read_text("/dev/zero"), support::InputError);
}

TEST_F(FileTest, replacesAFileInOneStep) {
    const fs::path path = with("a", "old");
    support::write_atomically(path, "new");
    EXPECT_EQ(support::read_text(path), "new");
    EXPECT_EQ(files(), 1U);
}

TEST_F(FileTest, leavesNoTraceOfAPendingFileThatIsDropped) {
    const fs::path path = with("a.txt", "old");
    {
        support::PendingFile pending(path);
        std::ofstream(pending.path()) << "half";
        EXPECT_EQ(pending.path().extension(), ".txt");
        EXPECT_EQ(support::read_text(path), "old");
    }
    EXPECT_EQ(support::read_text(path), "old");
    EXPECT_EQ(files(), 1U);
}

TEST_F(FileTest, cannotWriteWhereThereIsNoFolder) {
    EXPECT_THROW(support::write_atomically(folder_ / "none" / "a", "x"), support::Failure);
}

TEST_F(FileTest, makesAFolderWithItsParents) {
    support::make_writable_folder(folder_ / "a" / "b");
    EXPECT_TRUE(fs::is_directory(folder_ / "a" / "b"));
    EXPECT_TRUE(fs::is_empty(folder_ / "a" / "b"));
    EXPECT_NO_THROW(support::make_writable_folder(folder_ / "a" / "b"));
}

TEST_F(FileTest, refusesAFolderThatCannotBeMadeOrWritten) {
    EXPECT_THROW(support::make_writable_folder(with("file", "x")), support::InputError);
    EXPECT_THROW(support::make_writable_folder(folder_ / "file" / "below"), support::InputError);
    EXPECT_THROW(support::make_writable_folder("/proc/skin2afc"), support::InputError);
}

// FIPS 180-2, appendix B, and the digest of the empty message.
TEST_F(FileTest, hasTheStandardsDigests) {
    EXPECT_EQ(support::sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(support::sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(support::sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(support::sha256_of_file(with("million", std::string(1000000, 'a'))),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

} // namespace
