// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

namespace stats {

/// Answers, and how many of them chose the reference.
struct Tally {
    std::int64_t n = 0, reference_chosen = 0;
    auto operator<=>(const Tally&) const = default;
};

} // namespace stats
