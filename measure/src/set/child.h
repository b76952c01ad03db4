// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace measure {

/// Run a program to its end; what it prints is dropped. Throws support::Failure, with the last line of its
/// standard error stream, if it cannot be started or does not end with status 0.
void run_program(const std::filesystem::path& program, const std::vector<std::string>& arguments);

} // namespace measure
