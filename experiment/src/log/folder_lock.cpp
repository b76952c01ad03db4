// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "folder_lock.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <support/error.h>
#include <support/file.h>

#include "../interruption.h"

namespace experiment {
namespace {

int open_folder(const fs::path& folder) {
    const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0) {
        throw support::failure("{}: cannot be opened and locked: {}", folder.string(), std::strerror(errno));
    }
    return fd;
}

/// Lock an open folder; whether it could be had.
bool lock(int fd, int how, const fs::path& folder) {
    int result = 0;
    do {
        result = ::flock(fd, how);
    } while (result != 0 && errno == EINTR);
    if (result != 0 && errno != EWOULDBLOCK) {
        throw support::failure("{}: cannot be locked: {}", folder.string(), std::strerror(errno));
    }
    return result == 0;
}

bool is_still_there(int fd) {
    struct stat status {};
    return ::fstat(fd, &status) == 0 && status.st_nlink > 0;
}

} // namespace

FolderLock FolderLock::wait(const fs::path& folder, int how, const std::function<void()>& tell) {
    // Look again and again, so that whoever waits can be told, and the session be ended.
    constexpr useconds_t pause_us = 20000;
    constexpr int silent_looks = 25, most_looks = 250; // 0.5 s, 5 s
    FolderLock held(open_folder(folder));
    for (int look = 0; !lock(held.fd_, how | LOCK_NB, folder); ++look) {
        Interruption::check();
        if (look == silent_looks && tell) {
            tell();
        }
        if (look >= most_looks) {
            throw support::failure("{}: is held by another program", folder.string());
        }
        ::usleep(pause_us);
    }
    return held;
}

FolderLock FolderLock::wait(const fs::path& folder, const std::function<void()>& tell) {
    return wait(folder, LOCK_EX, tell);
}

FolderLock FolderLock::share(const fs::path& folder) { return wait(folder, LOCK_SH, {}); }

std::optional<FolderLock> FolderLock::attempt(const fs::path& folder) {
    while (true) {
        const auto missing = [](const fs::path& path) {
            std::error_code ignored;
            return fs::exists(path, ignored) ? fs::path() : path;
        };
        const fs::path made = missing(folder), made_parent = missing(folder.parent_path());
        support::make_writable_folder(folder.parent_path());
        support::make_writable_folder(folder);
        FolderLock held(open_folder(folder));
        if (!lock(held.fd_, LOCK_EX | LOCK_NB, folder)) {
            return std::nullopt;
        }
        // Another program may have taken the empty folder away between opening and locking.
        if (is_still_there(held.fd_)) {
            held.made_ = made;
            held.made_parent_ = made_parent;
            return held;
        }
    }
}

bool FolderLock::is_free(const fs::path& folder) {
    // The folder, or where it would be made.
    std::error_code unknown;
    const fs::path there = support::existing_part(folder);
    if (!fs::is_directory(there, unknown) || ::access(there.c_str(), W_OK | X_OK) != 0) {
        throw support::input_error("{}: expected a folder that can be written, found: {}", there.string(),
                                   fs::is_directory(there, unknown) ? std::strerror(errno)
                                                                    : "something else of that name");
    }
    if (!fs::exists(folder, unknown)) {
        return true;
    }
    const FolderLock held(open_folder(folder));
    return lock(held.fd_, LOCK_EX | LOCK_NB, folder);
}

FolderLock::~FolderLock() {
    for (const fs::path& folder : {made_, made_parent_}) {
        if (!folder.empty()) {
            ::rmdir(folder.c_str()); // refuses unless it is empty
        }
    }
    if (fd_ >= 0) {
        ::close(fd_);
    }
}

} // namespace experiment
