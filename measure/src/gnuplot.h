// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace measure {

/// The SVG that gnuplot makes of a script, which it reads without a user's settings. Throws support::Failure
/// if the program is missing or complains.
std::string gnuplot_svg(const std::string& script);

} // namespace measure
