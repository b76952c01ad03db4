// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "head_pigment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace stimuli::head {
namespace {

// Spectra every 10 nm from 400 to 700 nm.
constexpr std::size_t bands = 31;
constexpr double first_nm = 400, step_nm = 10;
using Spectrum = std::array<double, bands>;

// Relative power of daylight, CIE standard illuminant D65.
constexpr Spectrum daylight{82.75,  91.49,  93.43,  86.68,  104.86, 117.01, 117.81, 114.86,
                            115.92, 108.81, 109.35, 107.80, 104.79, 107.69, 104.41, 104.05,
                            100.00, 96.33,  95.79,  88.69,  90.01,  89.60,  87.70,  83.29,
                            83.70,  80.03,  80.21,  82.28,  78.28,  69.72,  71.61};

// Molar extinction of haemoglobin with and without oxygen, 1/(cm mol/l). [Prahl1998]
constexpr Spectrum oxygenated{266232, 466840, 480360, 246072, 102580, 62816, 44480, 33209,
                              26629,  23684,  20933,  20035,  24202,  39957, 53236, 43016,
                              32613,  44496,  50104,  14401,  3200,   1506,  942,   610,
                              442,    368,    319.6,  294,    277.6,  276,   290};
constexpr Spectrum deoxygenated{223296, 303956, 407560, 528600, 413280, 103292, 23389, 16156,
                                14550,  16684,  20862,  25774,  31590,  39036,  46592, 53412,
                                53788,  45072,  37020,  28324,  14677,  9444,   6510,  5149,
                                4345,   3750,   3227,   2795,   2408,   2052,   1794};

constexpr double oxygen_share = 0.90;    // of the blood, which is nearly arterial in the warm face
constexpr double eumelanin_share = 0.85; // of the melanin; the rest is pheomelanin
constexpr double blood_per_extinction =
    2.303 * 150 / 64500 / 10; // whole blood: 150 g/l of 64,500 g/mol, per mm

/// A lobe of the colour matching functions' analytic fit. [Wyman2013]
double lobe(double nm, double peak, double below, double above) {
    const double t = (nm - peak) * (nm < peak ? below : above);
    return std::exp(-0.5 * t * t);
}

/// The 1931 observer's response at a wavelength, XYZ.
glm::dvec3 observer(double nm) {
    return {0.362 * lobe(nm, 442.0, 0.0624, 0.0374) + 1.056 * lobe(nm, 599.8, 0.0264, 0.0323) -
                0.065 * lobe(nm, 501.1, 0.0490, 0.0382),
            0.821 * lobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * lobe(nm, 530.9, 0.0613, 0.0322),
            1.217 * lobe(nm, 437.0, 0.0845, 0.0278) + 0.681 * lobe(nm, 459.0, 0.0385, 0.0725)};
}

/// Absorption of tissue without pigment, 1/mm; less the model's constant part, which would keep red below the
/// 0.6 that fair skin reflects.
double bare(double nm) { return 8.53 * std::exp(-(nm - 154) / 66.2); }

double reflectance(const Pigment& pigment, double epidermis_mm, std::size_t band) {
    const double nm = first_nm + step_nm * static_cast<double>(band);
    const double melanin = static_cast<double>(pigment.melanin), blood = static_cast<double>(pigment.blood);
    const double in_melanin =
        eumelanin_share * 6.6e10 * std::pow(nm, -3.33) + (1 - eumelanin_share) * 2.9e14 * std::pow(nm, -4.75);
    const double epidermis = melanin * in_melanin + (1 - melanin) * bare(nm);
    const double in_blood =
        blood_per_extinction * (oxygen_share * oxygenated[band] + (1 - oxygen_share) * deoxygenated[band]);
    const double dermis = blood * in_blood + (1 - blood) * bare(nm);
    // Cells scatter in both layers, the dermis' fine fibres as small particles do.
    const double cells = 14.74 * std::pow(nm, -0.22), scattering = cells + 2.2e11 * std::pow(nm, -4.0);

    // The dipole's total, for an index of refraction of 1.4.
    constexpr double eta = 1.4, fresnel = -1.440 / (eta * eta) + 0.710 / eta + 0.668 + 0.0636 * eta;
    constexpr double boundary = (1 + fresnel) / (1 - fresnel);
    const double albedo = scattering / (scattering + dermis), root = std::sqrt(3 * (1 - albedo));
    const double below = albedo / 2 * (1 + std::exp(-4.0 / 3 * boundary * root)) * std::exp(-root);

    // What the epidermis reflects and lets through, by two fluxes [KubelkaMunk1931], and back and forth
    // between both.
    const double absorbed = 2 * epidermis, scattered = 0.75 * cells; // along diffuse paths
    const double a = 1 + absorbed / scattered, b = std::sqrt(a * a - 1), depth = b * scattered * epidermis_mm;
    const double all = a * std::sinh(depth) + b * std::cosh(depth);
    const double above = std::sinh(depth) / all, through = b / all;
    const double living = above + through * through * below / (1 - above * below);

    // Above it lies the horny layer, a quarter as thick, which scatters alike and holds no melanin.
    const double horny_depth = scattered * epidermis_mm / 4, horny = horny_depth / (1 + horny_depth);
    return horny + (1 - horny) * (1 - horny) * living / (1 - horny * living);
}

constexpr int melanin_steps = 64, blood_steps = 48;

// Steps of the table grow as the square: colour changes fastest where pigment is scarce.
float place(float amount, float most, int steps) {
    return std::sqrt(std::clamp(amount / most, 0.0F, 1.0F)) * static_cast<float>(steps);
}
float amount_at(int step, float most, int steps) {
    const float t = static_cast<float>(step) / static_cast<float>(steps);
    return most * t * t;
}

} // namespace

glm::vec3 skin_colour_exact(const Pigment& pigment, double epidermis_mm) {
    glm::dvec3 sum(0), white(0);
    for (std::size_t band = 0; band < bands; ++band) {
        const glm::dvec3 seen = daylight[band] * observer(first_nm + step_nm * static_cast<double>(band));
        white += seen;
        sum += seen * reflectance(pigment, epidermis_mm, band);
    }
    // Scale to the white of Rec. 709, which takes up what the fitted functions and the wide bands leave.
    const glm::dvec3 xyz = sum / white * glm::dvec3(0.95047, 1, 1.08883);
    const glm::dvec3 rgb(3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
                         -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
                         0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z);
    return glm::max(glm::vec3(rgb), glm::vec3(0));
}

SkinColours::SkinColours(double epidermis_mm) {
    for (int m = 0; m <= melanin_steps; ++m) {
        for (int b = 0; b <= blood_steps; ++b) {
            table_.push_back(skin_colour_exact(
                {amount_at(m, most_melanin, melanin_steps), amount_at(b, most_blood, blood_steps)},
                epidermis_mm));
        }
    }
}

glm::vec3 SkinColours::operator()(const Pigment& pigment) const {
    const float m = place(pigment.melanin, most_melanin, melanin_steps),
                b = place(pigment.blood, most_blood, blood_steps);
    const int i = std::min(static_cast<int>(m), melanin_steps - 1),
              j = std::min(static_cast<int>(b), blood_steps - 1);
    const auto at = [&](int di, int dj) {
        return table_[static_cast<std::size_t>((i + di) * (blood_steps + 1) + j + dj)];
    };
    const float right = b - static_cast<float>(j);
    return glm::mix(glm::mix(at(0, 0), at(0, 1), right), glm::mix(at(1, 0), at(1, 1), right),
                    m - static_cast<float>(i));
}

} // namespace stimuli::head
