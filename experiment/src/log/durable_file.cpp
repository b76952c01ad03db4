// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "durable_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <support/error.h>
#include <support/file.h>

namespace experiment {
namespace {

bool write_all(int fd, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(fd, text.data(), text.size());
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written < 0) {
            return false;
        }
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

/// Give a file its final name unless that is taken; errno says why not.
bool rename_if_free(const fs::path& from, const fs::path& to) {
    if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) {
        return true;
    }
    // Network file systems know no such renaming, but hard links.
    return errno == EINVAL && ::link(from.c_str(), to.c_str()) == 0 && ::unlink(from.c_str()) == 0;
}

} // namespace

void sync_folder(const fs::path& folder) {
    const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool flushed = fd >= 0 && (::fsync(fd) == 0 || errno == EINVAL); // EINVAL: cannot flush folders
    const int error = errno;
    if (fd >= 0) {
        ::close(fd);
    }
    if (!flushed) {
        throw support::failure("{}: cannot be flushed to the disk: {}", folder.string(),
                               std::strerror(error));
    }
}

std::optional<DurableFile> DurableFile::create(const fs::path& path, std::string_view first) {
    // Write the first text under another name.
    const fs::path pending =
        path.parent_path() / fmt::format(".{}.{}.pending", path.filename().string(), ::getpid());
    const int fd = ::open(pending.c_str(), O_CREAT | O_TRUNC | O_RDWR | O_APPEND | O_CLOEXEC, 0644);
    if (fd < 0) {
        throw support::failure("{}: cannot be created: {}", path.string(), std::strerror(errno));
    }
    DurableFile file(path, fd);
    ::flock(fd, LOCK_EX | LOCK_NB); // no one else knows the file yet
    if (!write_all(fd, first) || ::fsync(fd) != 0) {
        const int error = errno;
        ::unlink(pending.c_str());
        throw support::failure("{}: cannot be written: {}", path.string(), std::strerror(error));
    }
    file.content_ = first;
    // Take the final name.
    if (!rename_if_free(pending, path)) {
        const int error = errno;
        ::unlink(pending.c_str());
        if (error == EEXIST) {
            return std::nullopt;
        }
        throw support::failure("{}: cannot be created: {}", path.string(), std::strerror(error));
    }
    sync_folder(path.parent_path());
    return file;
}

DurableFile::~DurableFile() {
    if (fd_ >= 0) {
        ::close(fd_);
    }
}

bool DurableFile::in_place() const {
    struct stat named {};
    struct stat held {};
    return ::stat(path_.c_str(), &named) == 0 && ::fstat(fd_, &held) == 0 && named.st_dev == held.st_dev &&
           named.st_ino == held.st_ino;
}

/// A file that was deleted or moved takes writes without complaint, and they are lost to the study.
void DurableFile::check_unchanged() const {
    if (!in_place()) {
        throw support::failure("{}: was deleted or moved while the session ran", path_.string());
    }
    struct stat held {};
    if (::fstat(fd_, &held) == 0 && held.st_size != static_cast<off_t>(content_.size())) {
        throw support::failure("{}: was changed by another program while the session ran ({} bytes, not {}); "
                               "move it elsewhere, and it is written anew",
                               path_.string(), held.st_size, content_.size());
    }
}

void DurableFile::settle() {
    if (torn_ && (::ftruncate(fd_, static_cast<off_t>(content_.size())) != 0 || ::fsync(fd_) != 0)) {
        throw support::failure("{}: cannot be written: {}", path_.string(), std::strerror(errno));
    }
    torn_ = false;
}

void DurableFile::append(std::string_view text) {
    settle();
    check_unchanged();
    torn_ = true;
    if (!write_all(fd_, text) || ::fsync(fd_) != 0) {
        const int error = errno;
        // Take back what was written in part, so that the file keeps whole lines.
        torn_ = ::ftruncate(fd_, static_cast<off_t>(content_.size())) != 0;
        throw support::failure("{}: cannot be written: {}{}", path_.string(), std::strerror(error),
                               torn_ ? "; its last line may be torn" : "");
    }
    // A file that was taken away meanwhile keeps the text, but not for the study.
    if (!in_place()) {
        throw support::failure("{}: was deleted or moved while the session ran", path_.string());
    }
    content_ += text;
    torn_ = false;
}

DurableFile DurableFile::reopen(const fs::path& path, off_t whole) {
    const int fd = ::open(path.c_str(), O_RDWR | O_APPEND | O_CLOEXEC);
    if (fd < 0) {
        throw support::failure("{}: cannot be opened for writing: {}", path.string(), std::strerror(errno));
    }
    DurableFile file(path, fd);
    if (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
        throw support::input_error("{}: expected a log that no one writes to, found another session at it",
                                   path.string());
    }
    file.content_.resize(static_cast<std::size_t>(whole));
    if (::pread(fd, file.content_.data(), file.content_.size(), 0) != static_cast<ssize_t>(whole)) {
        throw support::failure("{}: cannot be read back: {}", path.string(), std::strerror(errno));
    }
    file.torn_ = true;
    return file;
}

DurableFile& DurableFile::operator=(DurableFile&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(fd_, other.fd_);
    std::swap(content_, other.content_);
    std::swap(torn_, other.torn_);
    return *this;
}

void DurableFile::restore() {
    if (in_place()) {
        return;
    }
    support::make_writable_folder(path_.parent_path());
    auto anew = create(path_, content_);
    if (!anew) {
        throw support::failure("{}: was deleted or moved, and another file has its name now; move that "
                               "elsewhere, and the session's is written anew",
                               path_.string());
    }
    *this = std::move(*anew);
}

} // namespace experiment
