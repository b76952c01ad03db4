// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <initializer_list>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <support/error.h>
#include <support/file.h>

namespace support {

/// One table of a TOML file. It checks type and range of every field, names file, line, field, expectation
/// and finding in each error, and remembers which fields were read, so that finish() can refuse the others.
class TomlTable {
public:
    /// Read a file's root table. Throws InputError for a missing file or wrong TOML.
    static TomlTable read(const fs::path& file);

    /// Whether the field is there; it then counts as known.
    bool has(std::string_view key);

    /// A finite number in [least, most]; the fallback when absent, an error when absent without fallback.
    double number(std::string_view key, double least, double most, std::optional<double> fallback = {});
    int integer(std::string_view key, int least, int most, std::optional<int> fallback = {});
    bool boolean(std::string_view key, std::optional<bool> fallback = {});
    std::string text(std::string_view key, std::optional<std::string> fallback = {});
    /// One of the given words.
    std::string word(std::string_view key, std::initializer_list<std::string_view> words,
                     std::optional<std::string> fallback = {});
    /// `count` finite numbers in [least, most] (any positive count if 0).
    std::vector<double> numbers(std::string_view key, std::size_t count, double least, double most,
                                std::optional<std::vector<double>> fallback = {});
    std::vector<std::string> texts(std::string_view key,
                                   std::optional<std::vector<std::string>> fallback = {});

    /// A sub-table; an empty one when absent.
    TomlTable table(std::string_view key);
    /// An array of tables; empty when absent.
    std::vector<TomlTable> tables(std::string_view key);

    /// Refuse every field that nothing has read, here and in the sub-tables that were opened.
    void finish() const;

    /// An error at this field: "FILE:LINE: FIELD: message".
    InputError error(std::string_view key, std::string_view message) const;

private:
    struct Node;
    explicit TomlTable(std::shared_ptr<Node> node) : node_(std::move(node)) {}
    template <typename T>
    T required(std::string_view key, std::optional<T> fallback, std::string_view expected) const;
    std::shared_ptr<Node> node_;
};

} // namespace support
