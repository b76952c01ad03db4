// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace stats {

/// Write texts into a folder, made if missing, by their names: all beside their places before the first is
/// put in place, so that a full disk changes none. Throws support::InputError for the folder,
/// support::Failure.
void write_together(const std::filesystem::path& folder, const std::map<std::string, std::string>& contents);

} // namespace stats
