// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
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

    /// Go on with a file of which the first `whole` bytes count; what follows is taken off. Throws
    /// support::InputError where another program writes to it, support::Failure.
    static DurableFile reopen(const fs::path& path, off_t whole);

    DurableFile(DurableFile&& other) noexcept
        : path_(std::move(other.path_)), fd_(std::exchange(other.fd_, -1)), size_(other.size_) {}
    DurableFile& operator=(DurableFile&& other) noexcept;
    ~DurableFile();

    /// Append and flush to the disk. Where it fails, what was there before stays as it was, and
    /// support::Failure is thrown.
    void append(std::string_view text);
    /// Where the file was deleted meanwhile, write all that it held anew. Throws support::Failure.
    void restore();
    const fs::path& path() const { return path_; }

private:
    DurableFile(fs::path path, int fd) : path_(std::move(path)), fd_(fd) {}
    bool was_deleted() const;

    fs::path path_;
    int fd_;
    off_t size_ = 0; // bytes known to be on the disk
};

} // namespace experiment
