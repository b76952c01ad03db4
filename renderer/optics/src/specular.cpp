// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <renderer/optics/specular.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace renderer::optics {

double beckmann(double NoH, double m) {
    const double c2 = NoH * NoH;
    const double tan2 = (1 - c2) / c2;
    return std::exp(-tan2 / (m * m)) / (m * m * c2 * c2);
}

double schlick(double VoH, double f0) { return f0 + (1 - f0) * std::pow(1 - VoH, 5); }

double specular_albedo(double cos_theta, double m, double f0) {
    // Light comes from L in the xz plane; sum over directions V on a grid of equal solid angles.
    const double cos_l = std::clamp(cos_theta, 1e-3, 1.0);
    const double sin_l = std::sqrt(1 - cos_l * cos_l);
    constexpr int rings = 48, sectors = 48;
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        const double cos_v = (i + 0.5) / rings;
        const double sin_v = std::sqrt(1 - cos_v * cos_v);
        for (int j = 0; j < sectors; ++j) {
            const double phi = std::numbers::pi * (j + 0.5) / sectors; // the other half is its mirror image
            const double hx = sin_l + sin_v * std::cos(phi);
            const double hy = sin_v * std::sin(phi);
            const double hz = cos_l + cos_v;
            const double hh = hx * hx + hy * hy + hz * hz; // |L+V|^2, h not normalised
            const double VoH = std::sqrt(hh) / 2;          // L and V are mirror images about h
            sum += beckmann(hz / std::sqrt(hh), m) * schlick(VoH, f0) / (std::numbers::pi * hh) * cos_v;
        }
    }
    const double solid_angle = 2 * std::numbers::pi / (rings * sectors);
    return std::min(1.0, sum * solid_angle);
}

std::vector<float> specular_albedo_table(int size, double f0) {
    std::vector<float> table;
    for (int row = 1; row <= size; ++row) {
        for (int column = 0; column < size; ++column) {
            table.push_back(static_cast<float>(specular_albedo(static_cast<double>(column) / (size - 1),
                                                               static_cast<double>(row) / size, f0)));
        }
    }
    return table;
}

} // namespace renderer::optics
