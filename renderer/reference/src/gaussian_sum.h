// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <vector>

#include <glm/glm.hpp>

namespace renderer::reference {

struct Cell;

/// Sources of light, each quantity in a row of its own so that several are computed at once.
class Sources {
public:
    void clear();
    void add(const Cell& cell);
    /// Fill up with dark sources to a whole number of blocks.
    void pad();
    std::size_t size() const { return rows_[x].size(); }

    /// The sum over all sources of light times the Gaussian of the distance, per mm^2, averaged over the
    /// source: exact to the second order of the source's size, and to all orders where it is flat, alike in
    /// its two directions, and looked at along its plane. The exponential has a relative error below 1e-6.
    /// Needs pad().
    glm::vec3 gaussian_sum(const glm::vec3& place_mm, float variance_mm2) const;

private:
    enum Row { x, y, z, red, green, blue, variance, xx, yy, zz, xy, yz, zx, row_count };
    std::array<std::vector<float>, row_count> rows_;
};

} // namespace renderer::reference
