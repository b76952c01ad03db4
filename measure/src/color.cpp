// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <measure/color.h>

#include <cmath>
#include <numbers>

namespace measure {
namespace {

/// The XYZ of a chromaticity at Y = 1.
glm::dvec3 xyz_of(double x, double y) { return {x / y, 1, (1 - x - y) / y}; }

/// Angle of a hue in degrees, [0, 360); 0 without a hue.
double hue_deg(double a, double b) {
    if (a == 0 && b == 0) {
        return 0;
    }
    const double angle = glm::degrees(std::atan2(b, a));
    return angle < 0 ? angle + 360 : angle;
}

double cos_deg(double angle) { return std::cos(glm::radians(angle)); }
double sin_deg(double angle) { return std::sin(glm::radians(angle)); }
double square(double x) { return x * x; }

/// sqrt(c^7 / (c^7 + 25^7)), the share of full chroma in two terms of CIEDE2000.
double saturation(double chroma) {
    const double c7 = std::pow(chroma, 7);
    return std::sqrt(c7 / (c7 + 6103515625.0));
}

/// A colour as lightness, adjusted chroma and adjusted hue.
struct Lch {
    double lightness, chroma, hue;
};

/// The mean of two hues along the shorter arc; the sum where one of the colours has none [Sharma2005, Eq.
/// 14].
double mean_hue(const Lch& first, const Lch& second) {
    const double sum = first.hue + second.hue;
    if (first.chroma * second.chroma == 0) {
        return sum;
    }
    if (std::abs(first.hue - second.hue) <= 180) {
        return sum / 2;
    }
    return sum < 360 ? (sum + 360) / 2 : (sum - 360) / 2;
}

/// The difference of two hues along the shorter arc; none where one of the colours has none [Sharma2005, Eq.
/// 10].
double hue_difference(const Lch& first, const Lch& second) {
    if (first.chroma * second.chroma == 0) {
        return 0;
    }
    const double difference = second.hue - first.hue;
    if (difference > 180) {
        return difference - 360;
    }
    return difference < -180 ? difference + 360 : difference;
}

} // namespace

const glm::dmat3& xyz_from_linear() {
    // Scale the primaries so that their sum is the white.
    static const glm::dmat3 matrix = [] {
        const glm::dmat3 primaries(xyz_of(0.64, 0.33), xyz_of(0.30, 0.60), xyz_of(0.15, 0.06));
        const glm::dvec3 scale = glm::inverse(primaries) * xyz_of(0.31271, 0.32902);
        return glm::dmat3(primaries[0] * scale.r, primaries[1] * scale.g, primaries[2] * scale.b);
    }();
    return matrix;
}

glm::dvec3 lab_from_linear(const glm::dvec3& linear) {
    static const glm::dvec3 white = xyz_from_linear() * glm::dvec3(1);
    const glm::dvec3 share = xyz_from_linear() * linear / white;
    glm::dvec3 f;
    for (int i = 0; i < 3; ++i) {
        // The cube root, and its tangent near black.
        constexpr double delta = 6.0 / 29;
        f[i] = share[i] > delta * delta * delta ? std::cbrt(share[i])
                                                : share[i] / (3 * delta * delta) + 4.0 / 29;
    }
    return {116 * f.y - 16, 500 * (f.x - f.y), 200 * (f.y - f.z)};
}

double ciede2000(const glm::dvec3& first_lab, const glm::dvec3& second_lab) {
    // Stretch a so that greys keep their place and low chromas count for more [Sharma2005, Eqs. 2-7].
    const double mean_plain_chroma =
        (std::hypot(first_lab.y, first_lab.z) + std::hypot(second_lab.y, second_lab.z)) / 2;
    const double stretch = 1 + 0.5 * (1 - saturation(mean_plain_chroma));
    const auto adjusted = [&](const glm::dvec3& lab) {
        const double a = stretch * lab.y;
        return Lch{lab.x, std::hypot(a, lab.z), hue_deg(a, lab.z)};
    };
    const Lch first = adjusted(first_lab);
    const Lch second = adjusted(second_lab);

    // Differences in lightness, chroma and hue [Sharma2005, Eqs. 8-11].
    const double dl = second.lightness - first.lightness;
    const double dc = second.chroma - first.chroma;
    const double dh =
        2 * std::sqrt(first.chroma * second.chroma) * sin_deg(hue_difference(first, second) / 2);

    // Weigh them by how well they are seen around the mean colour [Sharma2005, Eqs. 12-21].
    const double chroma = (first.chroma + second.chroma) / 2;
    const double hue = mean_hue(first, second);
    const double t = 1 - 0.17 * cos_deg(hue - 30) + 0.24 * cos_deg(2 * hue) + 0.32 * cos_deg(3 * hue + 6) -
                     0.20 * cos_deg(4 * hue - 63);
    const double from_50 = square((first.lightness + second.lightness) / 2 - 50);
    const double sl = 1 + 0.015 * from_50 / std::sqrt(20 + from_50);
    const double sc = 1 + 0.045 * chroma;
    const double sh = 1 + 0.015 * chroma * t;
    const double rotation = -2 * saturation(chroma) * sin_deg(60 * std::exp(-square((hue - 275) / 25)));
    return std::sqrt(square(dl / sl) + square(dc / sc) + square(dh / sh) + rotation * (dc / sc) * (dh / sh));
}

} // namespace measure
