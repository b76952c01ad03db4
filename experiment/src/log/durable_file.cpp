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
    try {
        file.append(first);
    } catch (const support::Failure&) {
        ::unlink(pending.c_str());
        throw;
    }
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

void DurableFile::append(std::string_view text) {
    if (!write_all(fd_, text) || ::fsync(fd_) != 0) {
        const int error = errno;
        // Take back what was written in part, so that the file keeps whole lines.
        const bool whole = ::ftruncate(fd_, size_) == 0;
        throw support::failure("{}: cannot be written: {}{}", path_.string(), std::strerror(error),
                               whole ? "" : "; its last line may be torn");
    }
    size_ += static_cast<off_t>(text.size());

    // A file deleted meanwhile takes writes without complaint and loses them.
    if (was_deleted()) {
        size_ -= static_cast<off_t>(text.size());
        throw support::failure("{}: was deleted while the session ran", path_.string());
    }
}

bool DurableFile::was_deleted() const {
    struct stat status {};
    return ::fstat(fd_, &status) == 0 && status.st_nlink == 0;
}

DurableFile DurableFile::reopen(const fs::path& path, off_t whole) {
    const int fd = ::open(path.c_str(), O_RDWR | O_APPEND | O_CLOEXEC);
    if (fd < 0) {
        throw support::failure("{}: cannot be opened for writing: {}", path.string(), std::strerror(errno));
    }
    DurableFile file(path, fd);
    file.size_ = whole;
    if (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
        throw support::input_error("{}: expected a log that no one writes to, found another session at it",
                                   path.string());
    }
    if (::ftruncate(fd, whole) != 0 || ::fsync(fd) != 0) {
        throw support::failure("{}: cannot be written: {}", path.string(), std::strerror(errno));
    }
    return file;
}

DurableFile& DurableFile::operator=(DurableFile&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(fd_, other.fd_);
    std::swap(size_, other.size_);
    return *this;
}

void DurableFile::restore() {
    if (!was_deleted()) {
        return;
    }
    std::string content(static_cast<std::size_t>(size_), '\0');
    if (::pread(fd_, content.data(), content.size(), 0) != static_cast<ssize_t>(size_)) {
        throw support::failure("{}: cannot be read back: {}", path_.string(), std::strerror(errno));
    }
    support::make_writable_folder(path_.parent_path());
    auto anew = create(path_, content);
    if (!anew) {
        throw support::failure("{}: was deleted, and another file has its name now", path_.string());
    }
    *this = std::move(*anew);
}

} // namespace experiment
