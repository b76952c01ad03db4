// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <measure/ssim.h>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <support/random.h>

namespace {

constexpr int width = 23, height = 17;
using Signal = std::vector<float>;

Signal noise(std::uint64_t seed) {
    support::Generator generator("ssim", seed);
    Signal signal(width * height);
    for (float& value : signal) {
        value = static_cast<float>(generator.uniform());
    }
    return signal;
}

/// The formula itself, as a double sum over the window around one pixel.
double naive(const Signal& a, const Signal& b, int x, int y) {
    double w = 0, ma = 0, mb = 0;
    const auto each = [&](auto visit) {
        for (int dy = -5; dy <= 5; ++dy) {
            for (int dx = -5; dx <= 5; ++dx) {
                const auto at = static_cast<std::size_t>(std::clamp(y + dy, 0, height - 1) * width +
                                                         std::clamp(x + dx, 0, width - 1));
                visit(std::exp(-(dx * dx + dy * dy) / 4.5), static_cast<double>(a[at]),
                      static_cast<double>(b[at]));
            }
        }
    };
    each([&](double g, double va, double vb) {
        w += g;
        ma += g * va;
        mb += g * vb;
    });
    ma /= w;
    mb /= w;
    double aa = 0, bb = 0, ab = 0;
    each([&](double g, double va, double vb) {
        aa += g / w * (va - ma) * (va - ma);
        bb += g / w * (vb - mb) * (vb - mb);
        ab += g / w * (va - ma) * (vb - mb);
    });
    return (2 * ma * mb + 1e-4) * (2 * ab + 9e-4) / ((ma * ma + mb * mb + 1e-4) * (aa + bb + 9e-4));
}

} // namespace

// Sums of floats near 0.1 over 121 weights are right to about 1e-6; the smallest denominator is near 0.1.
TEST(SsimTest, isTheFormulaOfTheArticle) {
    const Signal a = noise(1), b = noise(2);
    const auto map = measure::ssim_map(a, b, width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            EXPECT_NEAR(map[static_cast<std::size_t>(y * width + x)], naive(a, b, x, y), 2e-5)
                << x << ' ' << y;
        }
    }
}

// Float rounding of quotients that are 1.
TEST(SsimTest, isOneForTheSamePicture) {
    const Signal a = noise(3);
    for (const float value : measure::ssim_map(a, a, width, height)) {
        EXPECT_NEAR(value, 1, 1e-6);
    }
}

// Without structure only the means count: (2ab + C1) / (a^2 + b^2 + C1). Float rounding of variances near 0
// against C2 = 9e-4 leaves 1e-4.
TEST(SsimTest, comparesMeansOfConstants) {
    const Signal a(width * height, 0.3f), b(width * height, 0.6f);
    for (const float value : measure::ssim_map(a, b, width, height)) {
        EXPECT_NEAR(value, (2 * 0.3 * 0.6 + 1e-4) / (0.3 * 0.3 + 0.6 * 0.6 + 1e-4), 1e-4);
    }
}

TEST(SsimTest, isNegativeForTheNegative) {
    const Signal a = noise(4);
    Signal b = a;
    std::transform(b.begin(), b.end(), b.begin(), [](float value) { return 1 - value; });
    for (const float value : measure::ssim_map(a, b, width, height)) {
        EXPECT_LT(value, 0);
    }
}
