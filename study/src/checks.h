// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <support/toml_table.h>

namespace study {

/// Refuse what is no shader of this program.
void check_shader(const support::TomlTable& table, std::string_view key, const std::string& shader);

/// Refuse a value that comes twice.
template <typename T>
void check_unique(const support::TomlTable& table, std::string_view key, const std::vector<T>& values) {
    std::set<T> seen;
    for (const T& value : values) {
        if (!seen.insert(value).second) {
            throw table.error(key, fmt::format("expected each value once, found {} twice", value));
        }
    }
}

} // namespace study
