// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <string_view>

namespace support {

/// Refuse JSON text whose arrays and objects are nested deeper than any file of this program or any glTF
/// model is: code that walks such values recursively would run out of stack. Throws InputError; `name` stands
/// in it.
void check_json_depth(std::string_view json, const std::string& name);

} // namespace support
