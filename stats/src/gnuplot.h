// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace stats {

/// What gnuplot draws for a script, on its standard output. The program is found on PATH and reads no
/// settings of the user. Throws support::Failure when it is missing or reports an error.
std::string gnuplot(const std::string& script);

} // namespace stats
