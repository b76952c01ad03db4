// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

namespace CLI {
class App;
}

namespace measure {

/// Add the subcommand `bench`.
void add_bench(CLI::App& app);

} // namespace measure
