// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <support/random.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include <support/file.h>

namespace support {
namespace {

/// The first `words` 32-bit words of a text's SHA-256.
std::array<std::uint32_t, 8> digest_words(const std::string& text) {
    const std::string hex = sha256(text);
    std::array<std::uint32_t, 8> words{};
    for (std::size_t i = 0; i < words.size(); ++i) {
        words[i] = static_cast<std::uint32_t>(std::stoul(hex.substr(8 * i, 8), nullptr, 16));
    }
    return words;
}

} // namespace

Generator::Generator(std::string_view name, std::uint64_t seed) {
    const auto words = digest_words(fmt::format("{}:{}", name, seed));
    std::seed_seq sequence(words.begin(), words.end());
    engine_.seed(sequence);
}

std::uint64_t Generator::below(std::uint64_t n) {
    // Reject the numbers above the largest multiple of n.
    const std::uint64_t limit = std::numeric_limits<std::uint64_t>::max() / n * n;
    std::uint64_t x = next();
    while (x >= limit) {
        x = next();
    }
    return x % n;
}

double Generator::uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

double Generator::normal() {
    const double radius = std::sqrt(-2.0 * std::log1p(-uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

std::uint64_t seed_of(std::string_view text) {
    const auto words = digest_words(std::string(text));
    return ((std::uint64_t{words[0]} << 32) | words[1]) >> 11;
}

} // namespace support
