// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <support/json_depth.h>

#include <support/error.h>

namespace support {

// Manifests need 5 levels, glTF with its extensions about 10.
constexpr int deepest = 64;

void check_json_depth(std::string_view json, const std::string& name) {
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            i += c == '\\' ? 1 : 0; // what is escaped ends no string
            in_string = c != '"';
        } else if (c == '"') {
            in_string = true;
        } else if (c == '[' || c == '{') {
            ++depth;
        } else if (c == ']' || c == '}') {
            --depth;
        }
        if (depth > deepest) {
            throw input_error("{}: expected JSON nested at most {} deep, found more", name, deepest);
        }
    }
}

} // namespace support
