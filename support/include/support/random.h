// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <random>
#include <string_view>
#include <vector>

namespace support {

/// A named, seeded generator: the same name and seed give the same numbers on every machine.
/// 64-bit Mersenne Twister, seeded with the SHA-256 of name and seed; no std distribution is used, for their
/// output is not specified.
class Generator {
public:
    Generator(std::string_view name, std::uint64_t seed);

    /// Uniform over all 64-bit numbers.
    std::uint64_t next() { return engine_(); }
    /// Uniform over 0 ... n-1, without modulo bias; n > 0.
    std::uint64_t below(std::uint64_t n);
    /// Uniform over [0, 1), 53 bits.
    double uniform();
    /// Standard normal [BoxMuller1958].
    double normal();

    /// Fisher-Yates shuffle.
    template <typename T>
    void shuffle(std::vector<T>& items) {
        for (std::size_t i = items.size(); i > 1; --i) {
            std::swap(items[i - 1], items[static_cast<std::size_t>(below(i))]);
        }
    }

private:
    std::mt19937_64 engine_;
};

/// A seed that depends on the text alone, below 2^53 so that JSON keeps it exactly.
std::uint64_t seed_of(std::string_view text);

} // namespace support
