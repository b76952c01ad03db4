// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace support {

/// The SVG that gnuplot draws for a script, which sets the terminal and no output. The program is found on
/// PATH and reads no settings of the user. Throws Failure when it is missing, reports an error or draws
/// no SVG.
std::string gnuplot_svg(const std::string& script);

} // namespace support
