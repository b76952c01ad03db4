// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

namespace experiment {

namespace fs = std::filesystem;

/// A lock on a folder, of one program or shared, held while it lives; it goes with the program, however that
/// ends.
class FolderLock {
public:
    /// Wait until no other program holds the folder, some seconds at most; where that takes longer than
    /// anyone should wait without a word, `tell` is called once. Throws support::Failure, Interrupted.
    static FolderLock wait(const fs::path& folder, const std::function<void()>& tell = {});
    /// Hold the folder together with others that share it. Throws as wait() does.
    static FolderLock share(const fs::path& folder);
    /// Nothing where another program holds the folder. Makes the folder where there is none, and takes an
    /// empty one away again in the end. Throws support::Failure, InputError.
    static std::optional<FolderLock> attempt(const fs::path& folder);

    /// Whether attempt() would have it, as far as can be known without making anything. Throws
    /// support::InputError where the folder, or the one that it would be made in, cannot be written.
    static bool is_free(const fs::path& folder);

    FolderLock(FolderLock&& other) noexcept
        : fd_(std::exchange(other.fd_, -1)), made_(std::exchange(other.made_, fs::path())),
          made_parent_(std::exchange(other.made_parent_, fs::path())) {}
    FolderLock& operator=(FolderLock&&) = delete;
    ~FolderLock();

private:
    explicit FolderLock(int fd) : fd_(fd) {}
    static FolderLock wait(const fs::path& folder, int how, const std::function<void()>& tell);
    int fd_;
    fs::path made_, made_parent_; // to take away again where it stays empty
};

} // namespace experiment
