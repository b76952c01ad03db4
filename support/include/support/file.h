// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace support {

namespace fs = std::filesystem;

/// The whole file as bytes. Throws InputError when it is missing, not a plain file, unreadable, or larger
/// than `limit` bytes.
std::vector<std::uint8_t> read_bytes(const fs::path& path, std::uintmax_t limit = std::uintmax_t{4} << 30);

/// The whole file as text; errors as read_bytes.
std::string read_text(const fs::path& path, std::uintmax_t limit = std::uintmax_t{256} << 20);

/// A file that is written beside its final place and renamed there by commit(); dropped without commit, it
/// leaves no trace.
class PendingFile {
public:
    explicit PendingFile(fs::path final_path);
    ~PendingFile();
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    /// Where to write meanwhile; has the extension of the final path.
    const fs::path& path() const { return pending_; }
    /// Flush the file to the disk and rename it to its final path. Throws Failure.
    void commit();

private:
    fs::path final_, pending_;
    bool committed_ = false;
};

/// Replace the file's content in one step: readers see the old content or the new, never a part. Throws
/// Failure.
void write_atomically(const fs::path& path, std::string_view content);

/// Remove what PendingFile and make_writable_folder left in a folder when a program was killed. No other
/// program may be writing there. Throws nothing; what cannot be removed stays.
void remove_leftovers(const fs::path& folder);

/// The folder itself or, where it is not there, the nearest one above it that is.
fs::path existing_part(const fs::path& folder);

/// Make the folder, with its parents, and prove that it can be written into. Throws InputError.
void make_writable_folder(const fs::path& folder);

/// SHA-256 in lower-case hexadecimal, 64 characters.
std::string sha256(std::string_view bytes);
std::string sha256_of_file(const fs::path& path);

} // namespace support
