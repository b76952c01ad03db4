// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <support/file.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>

#include <fcntl.h>
#include <openssl/evp.h>
#include <unistd.h>

#include <support/error.h>

namespace support {
namespace {

/// Flush a file or folder to the disk.
void sync_path(const fs::path& path) {
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) {
        throw failure("{}: cannot be opened to flush it: {}", path.string(), std::strerror(errno));
    }
    const int result = ::fsync(fd);
    const int error = errno;
    ::close(fd);
    if (result != 0 && error != EINVAL) { // EINVAL: some file systems cannot flush folders
        throw failure("{}: cannot be flushed to the disk: {}", path.string(), std::strerror(error));
    }
}

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

class Sha256 {
public:
    Sha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
        if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) {
            throw Failure("SHA-256 is not available in the crypto library");
        }
    }
    void add(const void* data, std::size_t size) { EVP_DigestUpdate(context_.get(), data, size); }
    std::string hex() {
        unsigned char digest[EVP_MAX_MD_SIZE];
        unsigned int length = 0;
        EVP_DigestFinal_ex(context_.get(), digest, &length);
        std::string text;
        for (unsigned int i = 0; i < length; ++i) {
            text += fmt::format("{:02x}", digest[i]);
        }
        return text;
    }

private:
    std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

std::ifstream open_plain_file(const fs::path& path, std::uintmax_t limit) {
    std::error_code error;
    const auto status = fs::status(path, error);
    if (!fs::exists(status)) {
        throw input_error("{}: no such file", path.string());
    }
    if (!fs::is_regular_file(status)) {
        throw input_error("{}: expected a file, found {}", path.string(),
                          fs::is_directory(status) ? "a folder" : "a special file");
    }
    const auto size = fs::file_size(path, error);
    if (error || size > limit) {
        throw input_error("{}: expected at most {} bytes, found {}", path.string(), limit, size);
    }
    std::ifstream stream(path, std::ios::binary);
    if (!stream) {
        throw input_error("{}: cannot be read: {}", path.string(), std::strerror(errno));
    }
    return stream;
}

template <typename Buffer>
Buffer read_all(const fs::path& path, std::uintmax_t limit) {
    auto stream = open_plain_file(path, limit);
    Buffer buffer(static_cast<std::size_t>(fs::file_size(path)), typename Buffer::value_type{});
    stream.read(reinterpret_cast<char*>(buffer.data()), static_cast<std::streamsize>(buffer.size()));
    if (stream.gcount() != static_cast<std::streamsize>(buffer.size())) {
        throw input_error("{}: cannot be read to its end: {}", path.string(), std::strerror(errno));
    }
    return buffer;
}

} // namespace

std::vector<std::uint8_t> read_bytes(const fs::path& path, std::uintmax_t limit) {
    return read_all<std::vector<std::uint8_t>>(path, limit);
}

std::string read_text(const fs::path& path, std::uintmax_t limit) {
    return read_all<std::string>(path, limit);
}

PendingFile::PendingFile(fs::path final_path) : final_(std::move(final_path)) {
    pending_ = folder_of(final_) / fmt::format(".{}.{}.pending{}", final_.stem().string(), ::getpid(),
                                               final_.extension().string());
}

PendingFile::~PendingFile() {
    if (!committed_) {
        std::error_code ignored;
        fs::remove(pending_, ignored);
    }
}

void PendingFile::commit() {
    sync_path(pending_);
    std::error_code error;
    fs::rename(pending_, final_, error);
    if (error) {
        throw failure("{}: cannot be put in place: {}", final_.string(), error.message());
    }
    committed_ = true;
    sync_path(folder_of(final_));
}

void write_atomically(const fs::path& path, std::string_view content) {
    PendingFile pending(path);
    {
        std::ofstream stream(pending.path(), std::ios::binary);
        stream.write(content.data(), static_cast<std::streamsize>(content.size()));
        stream.flush();
        if (!stream) {
            throw failure("{}: cannot be written: {}", path.string(), std::strerror(errno));
        }
    }
    pending.commit();
}

void remove_leftovers(const fs::path& folder) {
    std::error_code none;
    std::vector<fs::path> leftovers;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
        const std::string name = entry.path().filename().string();
        const bool ours = name.starts_with(".probe.") ||
                          (name.starts_with(".") && name.find(".pending") != std::string::npos);
        if (ours && entry.is_regular_file(none)) {
            leftovers.push_back(entry.path());
        }
    }
    for (const fs::path& leftover : leftovers) {
        fs::remove(leftover, none);
    }
}

fs::path existing_part(const fs::path& folder) {
    std::error_code unknown;
    fs::path there = fs::absolute(folder);
    while (!fs::exists(there, unknown) && there.has_relative_path()) {
        there = there.parent_path();
    }
    return there;
}

void make_writable_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    std::error_code unknown;
    if (!fs::is_directory(folder, unknown)) {
        throw input_error("{}: expected a folder that can be made or written, found {}", folder.string(),
                          error ? error.message() : std::string("something else of that name"));
    }
    const fs::path probe = folder / fmt::format(".probe.{}", ::getpid());
    const int fd = ::open(probe.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0600);
    if (fd < 0) {
        throw input_error("{}: expected a folder that can be written, found: {}", folder.string(),
                          std::strerror(errno));
    }
    ::close(fd);
    fs::remove(probe, error);
}

std::string sha256(std::string_view bytes) {
    Sha256 hash;
    hash.add(bytes.data(), bytes.size());
    return hash.hex();
}

std::string sha256_of_file(const fs::path& path) {
    auto stream = open_plain_file(path, ~std::uintmax_t{0});
    Sha256 hash;
    std::vector<char> block(std::size_t{1} << 20);
    while (stream) {
        stream.read(block.data(), static_cast<std::streamsize>(block.size()));
        hash.add(block.data(), static_cast<std::size_t>(stream.gcount()));
    }
    if (stream.bad()) {
        throw input_error("{}: cannot be read to its end", path.string());
    }
    return hash.hex();
}

} // namespace support
