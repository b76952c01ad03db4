// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <renderer/optics/specular.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <numbers>
#include <thread>

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
    struct Sector {
        double cos_phi, sin_phi;
    };
    static const auto directions = [] {
        std::array<Sector, sectors> result{};
        for (int j = 0; j < sectors; ++j) {
            const double phi = std::numbers::pi * (j + 0.5) / sectors; // the other half is its mirror image
            result[static_cast<std::size_t>(j)] = {std::cos(phi), std::sin(phi)};
        }
        return result;
    }();
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        const double cos_v = (i + 0.5) / rings;
        const double sin_v = std::sqrt(1 - cos_v * cos_v);
        for (const Sector& sector : directions) {
            const double hx = sin_l + sin_v * sector.cos_phi;
            const double hy = sin_v * sector.sin_phi;
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
    std::vector<float> table(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    const auto fill_rows = [&](int first, int step) {
        for (int row = first; row < size; row += step) {
            for (int column = 0; column < size; ++column) {
                table[static_cast<std::size_t>(row * size + column)] = static_cast<float>(specular_albedo(
                    static_cast<double>(column) / (size - 1), static_cast<double>(row + 1) / size, f0));
            }
        }
    };
    // The rows are shared out among the processors.
    const int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    std::vector<std::future<void>> others;
    for (int thread = 1; thread < threads; ++thread) {
        others.push_back(std::async(std::launch::async, fill_rows, thread, threads));
    }
    fill_rows(0, threads);
    for (std::future<void>& other : others) {
        other.get();
    }
    return table;
}

} // namespace renderer::optics
