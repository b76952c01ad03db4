// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "gaussian_sum.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numbers>

#include "cells.h"

namespace renderer::reference {
namespace {

constexpr std::size_t block = 16;

/// exp(x) for x from -87 to 0, written so that compilers make it a vector operation.
inline float exponential(float x) {
    // Split x / ln 2 into a whole number, by adding a number so large that no fraction is left, and a rest.
    constexpr float shift = 12582912; // 1.5 * 2^23
    const float scaled = x * std::numbers::log2e_v<float>;
    const float shifted = scaled + shift;
    const float f = (scaled - (shifted - shift)) * std::numbers::ln2_v<float>;
    // Taylor's series; |f| <= ln(2) / 2, so the first term left out is below 2e-7.
    const float series =
        1 + f * (1 + f * (1 / 2.0f + f * (1 / 6.0f + f * (1 / 24.0f + f * (1 / 120.0f + f * (1 / 720.0f))))));
    const std::uint32_t exponent = std::bit_cast<std::uint32_t>(shifted) << 23;
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(series) + exponent);
}

} // namespace

void Sources::clear() {
    for (std::vector<float>& row : rows_) {
        row.clear();
    }
}

void Sources::add(const Cell& cell) {
    // Half the trace is the variance of a flat source; the rest of the covariance corrects for its shape.
    // With G widened by the variance s, the mean of G over a source of covariance C is, to the second order,
    // G (1 + d' (C - s) d / 2v^2).
    const float s = 0.5f * cell.covariance.trace();
    const glm::vec3& diagonal = cell.covariance.diagonal;
    const glm::vec3& off = cell.covariance.off_diagonal;
    const float values[row_count] = {cell.place_mm.x,
                                     cell.place_mm.y,
                                     cell.place_mm.z,
                                     cell.light.r,
                                     cell.light.g,
                                     cell.light.b,
                                     s,
                                     0.5f * (diagonal.x - s),
                                     0.5f * (diagonal.y - s),
                                     0.5f * (diagonal.z - s),
                                     off.x,
                                     off.y,
                                     off.z};
    for (std::size_t i = 0; i < row_count; ++i) {
        rows_[i].push_back(values[i]);
    }
}

void Sources::pad() {
    const std::size_t whole = (size() + block - 1) / block * block;
    for (std::vector<float>& row : rows_) {
        row.resize(whole, 0.0f);
    }
}

glm::vec3 Sources::gaussian_sum(const glm::vec3& place_mm, float variance_mm2) const {
    float sums[3][block] = {};
    for (std::size_t first = 0; first < size(); first += block) {
        const float* source[row_count];
        for (std::size_t i = 0; i < row_count; ++i) {
            source[i] = &rows_[i][first];
        }
        for (std::size_t i = 0; i < block; ++i) {
            const float dx = source[x][i] - place_mm.x;
            const float dy = source[y][i] - place_mm.y;
            const float dz = source[z][i] - place_mm.z;
            const float inverse = 1 / (variance_mm2 + source[variance][i]);
            const float exponent = -0.5f * (dx * dx + dy * dy + dz * dz) * inverse;
            const float shape = dx * (dx * source[xx][i] + dy * source[xy][i]) +
                                dy * (dy * source[yy][i] + dz * source[yz][i]) +
                                dz * (dz * source[zz][i] + dx * source[zx][i]);
            const float value = inverse * exponential(std::max(exponent, -80.0f)) *
                                (1 + std::max(shape * inverse * inverse, -1.0f));
            sums[0][i] += value * source[red][i];
            sums[1][i] += value * source[green][i];
            sums[2][i] += value * source[blue][i];
        }
    }
    glm::vec3 sum(0);
    for (std::size_t i = 0; i < block; ++i) {
        sum += glm::vec3(sums[0][i], sums[1][i], sums[2][i]);
    }
    return sum / (2 * std::numbers::pi_v<float>);
}

} // namespace renderer::reference
