// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <measure/flip.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/glm.hpp>

#include <measure/color.h>

#include "convolution.h"

namespace measure {
namespace {

// Constants of [Andersson2020, Sec. 4]; the exponents and shares are its q_c, p_c, p_t, q_f and w.
constexpr float color_exponent = 0.7f, knee = 0.4f, knee_value = 0.95f, feature_exponent = 0.5f;
constexpr double feature_width_deg = 0.082;

constexpr double pi = std::numbers::pi;

/// a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees: an eye's contrast sensitivity as a filter [Andersson2020,
/// Eq. 2].
struct Sensitivity {
    double a, b;
};
constexpr std::array<Sensitivity, 1> achromatic{{{1, 0.0047}}};
constexpr std::array<Sensitivity, 1> red_green{{{1, 0.0053}}};
constexpr std::array<Sensitivity, 2> blue_yellow{{{34.1, 0.04}, {13.5, 0.025}}};

/// Three planes of one image.
using Planes = std::array<Plane, 3>;

Taps scaled(const std::vector<double>& values, double factor) {
    Taps taps;
    for (const double value : values) {
        taps.push_back(static_cast<float>(factor * value));
    }
    return taps;
}

/// Blur one channel as the eye does: a sum of Gaussians, each separable, of weights that sum to 1.
template <std::size_t n>
Plane as_seen(const Plane& plane, Size size, const std::array<Sensitivity, n>& sensitivity,
              double pixels_per_degree) {
    // All filters reach as far as three standard deviations of the widest.
    const double widest_deg = std::sqrt(blue_yellow[0].b / (2 * pi * pi));
    const int radius = static_cast<int>(std::ceil(3 * widest_deg * pixels_per_degree));
    std::array<std::vector<double>, n> profiles;
    std::array<double, n> weights;
    double total = 0;
    for (std::size_t i = 0; i < n; ++i) {
        double sum = 0;
        for (int x = -radius; x <= radius; ++x) {
            const double x_deg = x / pixels_per_degree;
            profiles[i].push_back(std::exp(-pi * pi * x_deg * x_deg / sensitivity[i].b));
            sum += profiles[i].back();
        }
        weights[i] = sensitivity[i].a * std::sqrt(pi / sensitivity[i].b);
        total += weights[i] * sum * sum;
    }
    Plane result;
    for (std::size_t i = 0; i < n; ++i) {
        const Plane rows = filtered_along_rows(plane, size, scaled(profiles[i], 1));
        Plane term = filtered_along_columns(rows, size, scaled(profiles[i], weights[i] / total));
        if (result.empty()) {
            result = std::move(term);
        } else {
            std::transform(result.begin(), result.end(), term.begin(), result.begin(), std::plus<>());
        }
    }
    return result;
}

/// Linear light to XYZ as shares of the white, and back.
const glm::mat3& share_from_linear() {
    static const glm::mat3 matrix = [] {
        glm::dmat3 rows = glm::transpose(xyz_from_linear());
        for (int i = 0; i < 3; ++i) {
            rows[i] /= rows[i][0] + rows[i][1] + rows[i][2];
        }
        return glm::mat3(glm::transpose(rows));
    }();
    return matrix;
}
const glm::mat3& linear_from_share() {
    static const glm::mat3 matrix(glm::inverse(glm::dmat3(share_from_linear())));
    return matrix;
}

/// The linearised L*a*b* in which filters act [Andersson2020, Sec. 4.1].
Planes opponent(std::span<const float> linear, Size size) {
    Planes planes;
    planes.fill(Plane(size.pixels()));
    for_each_in_parallel(size.pixels(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const glm::vec3 rgb(linear[3 * i], linear[3 * i + 1], linear[3 * i + 2]);
            const glm::vec3 xyz = share_from_linear() * glm::clamp(rgb, 0.0f, 1.0f);
            planes[0][i] = 116 * xyz.y - 16;
            planes[1][i] = 500 * (xyz.x - xyz.y);
            planes[2][i] = 200 * (xyz.y - xyz.z);
        }
    });
    return planes;
}

/// L*a*b* of XYZ as shares of the white, a and b scaled down in the dark as the Hunt effect has it.
glm::vec3 hunt_lab(const glm::vec3& xyz) {
    glm::vec3 f;
    for (int i = 0; i < 3; ++i) {
        constexpr float delta = 6.0f / 29;
        f[i] = xyz[i] > delta * delta * delta ? std::cbrt(xyz[i]) : xyz[i] / (3 * delta * delta) + 4.0f / 29;
    }
    const float lightness = 116 * f.y - 16;
    const float hunt = 0.01f * lightness;
    return {lightness, hunt * 500 * (f.x - f.y), hunt * 200 * (f.y - f.z)};
}

/// The colour that remains of a filtered pixel on a display.
glm::vec3 hunt_lab_of_filtered(const Planes& seen, std::size_t i) {
    const float y = (seen[0][i] + 16) / 116;
    const glm::vec3 xyz(y + seen[1][i] / 500, y, y - seen[2][i] / 200);
    return hunt_lab(share_from_linear() * glm::clamp(linear_from_share() * xyz, 0.0f, 1.0f));
}

/// HyAB distance, lightness apart from the plane of hues, to the power q_c.
float color_distance(const glm::vec3& first, const glm::vec3& second) {
    const glm::vec3 d = first - second;
    const float hyab = std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
    return std::pow(hyab, color_exponent);
}

/// Spread distances over [0, 1]: those up to the knee share nearly all of it [Andersson2020, Sec. 4.1].
float redistributed(float distance) {
    static const float largest = color_distance(hunt_lab(share_from_linear() * glm::vec3(0, 1, 0)),
                                                hunt_lab(share_from_linear() * glm::vec3(0, 0, 1)));
    const float bend = knee * largest;
    return distance < bend ? knee_value / bend * distance
                           : knee_value + (distance - bend) / (largest - bend) * (1 - knee_value);
}

/// How strong edges and points are: magnitudes of the first and second derivatives of the blurred lightness.
struct Features {
    Plane edges, points;
};

/// Derivatives of a Gaussian as taps, positive weights summing to 1, negative ones to -1 (the Gaussian: to
/// 1).
struct FeatureTaps {
    Taps gaussian, first, second;

    explicit FeatureTaps(double pixels_per_degree) {
        const double sigma_px = 0.5 * feature_width_deg * pixels_per_degree;
        const int radius = static_cast<int>(std::ceil(3 * sigma_px));
        std::vector<double> g, d, dd;
        for (int x = -radius; x <= radius; ++x) {
            const double share = x / sigma_px;
            g.push_back(std::exp(-share * share / 2));
            d.push_back(-share * g.back());
            dd.push_back((share * share - 1) * g.back());
        }
        gaussian = normalised(g);
        first = normalised(d);
        second = normalised(dd);
    }

    static Taps normalised(const std::vector<double>& values) {
        double positive = 0, negative = 0;
        for (const double value : values) {
            (value > 0 ? positive : negative) += std::abs(value);
        }
        Taps taps;
        for (const double value : values) {
            taps.push_back(static_cast<float>(value / (value > 0 ? positive : negative)));
        }
        return taps;
    }
};

Plane magnitudes(const Plane& x, const Plane& y) {
    Plane result(x.size());
    std::transform(x.begin(), x.end(), y.begin(), result.begin(),
                   [](float a, float b) { return std::sqrt(a * a + b * b); });
    return result;
}

Features features(const Plane& opponent_lightness, Size size, double pixels_per_degree) {
    Plane lightness(opponent_lightness.size());
    std::transform(opponent_lightness.begin(), opponent_lightness.end(), lightness.begin(),
                   [](float value) { return (value + 16) / 116; });
    const FeatureTaps taps(pixels_per_degree);
    const Plane blurred = filtered_along_rows(lightness, size, taps.gaussian);
    const auto across = [&](const Taps& along_x) {
        return filtered_along_columns(filtered_along_rows(lightness, size, along_x), size, taps.gaussian);
    };
    return {magnitudes(across(taps.first), filtered_along_columns(blurred, size, taps.first)),
            magnitudes(across(taps.second), filtered_along_columns(blurred, size, taps.second))};
}

} // namespace

std::vector<float> flip_map(std::span<const float> image, std::span<const float> reference, int width,
                            int height, double pixels_per_degree) {
    // Filter both images as the eye does, and find their features.
    const Size size{width, height};
    std::array<Planes, 2> seen;
    std::array<Features, 2> found;
    for (std::size_t k = 0; k < 2; ++k) {
        const Planes planes = opponent(k == 0 ? image : reference, size);
        found[k] = features(planes[0], size, pixels_per_degree);
        seen[k] = {as_seen(planes[0], size, achromatic, pixels_per_degree),
                   as_seen(planes[1], size, red_green, pixels_per_degree),
                   as_seen(planes[2], size, blue_yellow, pixels_per_degree)};
    }

    // A feature that one image lacks raises the difference in colour [Andersson2020, Sec. 4.3].
    std::vector<float> result(size.pixels());
    for_each_in_parallel(size.pixels(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const float color = redistributed(
                color_distance(hunt_lab_of_filtered(seen[0], i), hunt_lab_of_filtered(seen[1], i)));
            const float feature = std::max(std::abs(found[0].edges[i] - found[1].edges[i]),
                                           std::abs(found[0].points[i] - found[1].points[i]));
            const float strength =
                std::pow(std::min(feature / std::numbers::sqrt2_v<float>, 1.0f), feature_exponent);
            result[i] = std::pow(color, 1 - strength);
        }
    });
    return result;
}

} // namespace measure
