// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <sys/types.h>

namespace experiment {

namespace fs = std::filesystem;

/// Flush a folder's entries to the disk. Throws support::Failure.
void sync_folder(const fs::path& folder);

/// A file that only grows, under a lock that one program holds; each append is on the disk when it returns.
class DurableFile {
public:
    /// Create the file with its first text, both in one step, so that no one ever sees it without; nothing
    /// where a file of that name exists. Throws support::Failure.
    static std::optional<DurableFile> create(const fs::path& path, std::string_view first);

    /// Go on with a file of which the first `whole` bytes count; what follows stays until settle() or
    /// append(). Throws support::InputError where another program writes to it, support::Failure.
    static DurableFile reopen(const fs::path& path, off_t whole);

    DurableFile(DurableFile&& other) noexcept
        : path_(std::move(other.path_)), fd_(std::exchange(other.fd_, -1)),
          content_(std::move(other.content_)), torn_(other.torn_) {}
    DurableFile& operator=(DurableFile&& other) noexcept;
    ~DurableFile();

    /// Append and flush to the disk. Where it fails, or the file is no longer what it was, what was there
    /// before stays as it was, and support::Failure is thrown.
    void append(std::string_view text);
    /// Take off what does not count. Throws support::Failure.
    void settle();
    /// Where the file was deleted or moved meanwhile, write all that it held anew. Throws support::Failure,
    /// InputError.
    void restore();
    /// Throws support::Failure where the file was deleted, moved or changed meanwhile.
    void check_unchanged() const;
    /// Whether the file is still the one of its name.
    bool in_place() const;
    /// All that counts.
    const std::string& content() const { return content_; }
    const fs::path& path() const { return path_; }

private:
    DurableFile(fs::path path, int fd) : path_(std::move(path)), fd_(fd) {}

    fs::path path_;
    int fd_;
    std::string content_; // known to be on the disk
    bool torn_ = false;   // whether the file may hold more than that
};

} // namespace experiment
