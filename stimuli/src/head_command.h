// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

namespace CLI {
class App;
}

namespace stimuli {

/// Add the subcommand that writes the built-in head to a file.
void add_head_command(CLI::App& app);

} // namespace stimuli
