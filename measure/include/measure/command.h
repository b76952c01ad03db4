// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

namespace CLI {
class App;
}

namespace measure {

/// Add this module's subcommands to the program's command line.
void add_command(CLI::App& app);

} // namespace measure
