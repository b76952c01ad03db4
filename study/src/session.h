// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

#include <study/session.h>
#include <support/toml_table.h>

namespace study {

/// Read a protocol's table [session]; `shaders` are the protocol's.
SessionSettings read_session(support::TomlTable table, const std::vector<std::string>& shaders);

} // namespace study
