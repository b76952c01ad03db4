// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

namespace CLI {
class App;
}

namespace measure {

/// Add `frames` to the command `bench`.
void add_bench_frames(CLI::App& bench);

} // namespace measure
