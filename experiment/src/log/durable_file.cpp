// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "durable_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <support/error.h>

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
    const int fd = ::open(pending.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_APPEND | O_CLOEXEC, 0644);
    if (fd < 0) {
        throw support::failure("{}: cannot be created: {}", path.string(), std::strerror(errno));
    }
    DurableFile file(path, fd);
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
    struct stat status {};
    if (::fstat(fd_, &status) == 0 && status.st_nlink == 0) {
        throw support::failure("{}: was deleted while the session ran", path_.string());
    }
}

} // namespace experiment
