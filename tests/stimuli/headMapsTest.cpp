// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include <gtest/gtest.h>

#include "head_under_test.h"

namespace {

using renderer::scene::Image;
using renderer::scene::Vertex;

/// The vertex nearest to a place.
const Vertex& nearest(glm::vec3 place) {
    return *std::min_element(
        mesh().vertices.begin(), mesh().vertices.end(), [&](const Vertex& a, const Vertex& b) {
            return glm::distance(a.position_mm, place) < glm::distance(b.position_mm, place);
        });
}

/// A texel's channels, 0 to 1, alpha being 1 where there is none; x wraps around.
glm::vec4 texel(const Image& image, int x, int y) {
    const int column = (x + image.width) % image.width;
    const auto at = static_cast<std::size_t>(image.channels * (y * image.width + column));
    const std::uint8_t alpha = image.channels == 4 ? image.pixels[at + 3] : 255;
    return glm::vec4(image.pixels[at], image.pixels[at + 1], image.pixels[at + 2], alpha) / 255.0F;
}

/// Mean of a map around a vertex, over a square of texels.
glm::vec4 mean_around(const Image& image, const Vertex& vertex, int reach) {
    const int x = static_cast<int>(vertex.uv.x * static_cast<float>(image.width));
    const int y = static_cast<int>(vertex.uv.y * static_cast<float>(image.height));
    glm::vec4 sum(0);
    for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
            sum += texel(image, x + dx, y + dy);
        }
    }
    return sum / static_cast<float>((2 * reach + 1) * (2 * reach + 1));
}

float linear_of(float srgb) {
    return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F);
}

TEST(HeadMapsTest, hasTheColourOfSkin) {
    const Image& albedo = *head().materials.front().base_color;
    glm::vec3 sum(0);
    for (int y = 0; y < albedo.height; ++y) {
        for (int x = 0; x < albedo.width; ++x) {
            const glm::vec3 colour = texel(albedo, x, y);
            sum += glm::vec3(linear_of(colour.x), linear_of(colour.y), linear_of(colour.z));
        }
    }
    const glm::vec3 mean = sum / static_cast<float>(albedo.width * albedo.height);
    // The range that the project calls light skin: a quarter around linear (0.55, 0.33, 0.24).
    EXPECT_GT(mean.x, 0.41F);
    EXPECT_LT(mean.x, 0.69F);
    EXPECT_GT(mean.y, 0.25F);
    EXPECT_LT(mean.y, 0.41F);
    EXPECT_GT(mean.z, 0.18F);
    EXPECT_LT(mean.z, 0.30F);
}

TEST(HeadMapsTest, reddensLipsCheeksAndNose) {
    const Image& albedo = *head().materials.front().base_color;
    const auto redness = [&](glm::vec3 place) {
        const glm::vec3 colour = mean_around(albedo, nearest(place), 5);
        return linear_of(colour.x) / linear_of(colour.y);
    };
    const float forehead = redness({20, 50, 92}), lips = redness({0, -74, 100});
    EXPECT_GT(redness({42, -32, 76}), 1.05F * forehead);
    EXPECT_GT(redness({0, -38, 115}), 1.05F * forehead);
    EXPECT_GT(lips, 1.2F * redness({42, -32, 76}));
}

TEST(HeadMapsTest, matchesAcrossTheSeam) {
    // Across the seam, texels differ as neighbours do anywhere near it; a half more is allowed for chance.
    const auto& material = head().materials.front();
    for (const auto& image : {material.base_color, material.normal, material.roughness}) {
        const auto difference = [&](int x) {
            double sum = 0;
            for (int y = 0; y < image->height; ++y) {
                sum += static_cast<double>(glm::length(texel(*image, x, y) - texel(*image, x + 1, y)));
            }
            return sum;
        };
        double near = 0;
        for (int x = 0; x < 8; ++x) {
            near += difference(x) / 8;
        }
        EXPECT_LT(difference(image->width - 1), 1.5 * near);
    }
    // Vertices at one place on both sides share normal and tangent.
    std::map<glm::vec3, const Vertex*, PlaceOrder> left;
    for (const Vertex& vertex : mesh().vertices) {
        if (vertex.uv.x == 0) {
            left[vertex.position_mm] = &vertex;
        }
    }
    int pairs = 0;
    for (const Vertex& vertex : mesh().vertices) {
        if (vertex.uv.x == 1) {
            const auto found = left.find(vertex.position_mm);
            ASSERT_NE(found, left.end());
            EXPECT_EQ(found->second->normal, vertex.normal);
            EXPECT_EQ(found->second->tangent, vertex.tangent);
            ++pairs;
        }
    }
    EXPECT_GT(pairs, 100);
}

TEST(HeadMapsTest, bumpsAreRoughAndUpright) {
    const Image& normals = *head().materials.front().normal;
    double slope2 = 0;
    int texels = 0;
    for (int y = normals.height / 4; y < normals.height * 3 / 4; ++y) {
        for (int x = normals.width / 4; x < normals.width * 3 / 4; ++x) {
            const glm::vec3 n = texel(normals, x, y) * 2.0F - 1.0F;
            // Rounding to 8 bits moves each component by up to 1/255.
            ASSERT_NEAR(glm::length(n), 1, 0.014);
            ASSERT_GT(n.z, 0);
            slope2 += static_cast<double>((n.x * n.x + n.y * n.y) / (n.z * n.z));
            ++texels;
        }
    }
    // Under light at 45 degrees a slope s changes Lambert's cosine by s of it: one to four tenths read as
    // rough skin.
    const double slope = std::sqrt(slope2 / texels);
    EXPECT_GT(slope, 0.1);
    EXPECT_LT(slope, 0.4);
}

TEST(HeadMapsTest, lightsTheLineBetweenTheLipsAsAGroove) {
    // On the midline +u runs along +x and the image's up along +y; a groove's upper wall faces down.
    const Vertex& middle = nearest({0, -69.2F, 96});
    EXPECT_GT(middle.tangent.x, 0.9F);
    EXPECT_GT((glm::cross(middle.normal, glm::vec3(middle.tangent)) * middle.tangent.w).y, 0.5F);

    // The groove is the darkest row near the midline; compare the rows above and below it.
    const auto& material = head().materials.front();
    const int x = static_cast<int>(middle.uv.x * 2048), near_y = static_cast<int>(middle.uv.y * 2048);
    int line_y = near_y;
    for (int y = near_y - 24; y <= near_y + 24; ++y) {
        line_y = texel(*material.base_color, x, y).x < texel(*material.base_color, x, line_y).x ? y : line_y;
    }
    float above = 0, below = 0;
    for (int dx = -20; dx <= 20; ++dx) {
        for (int k = 1; k <= 3; ++k) {
            above += texel(*material.normal, x + dx, line_y - k).y / 123;
            below += texel(*material.normal, x + dx, line_y + k).y / 123;
        }
    }
    EXPECT_LT(above, below - 0.2F);
}

TEST(HeadMapsTest, reflectsMoreWhereSkinIsOilyOrMoist) {
    const renderer::scene::Material& skin = head().materials.front();
    ASSERT_EQ(skin.specular->channels, 4);
    const auto strength = [&](glm::vec3 place) { return mean_around(*skin.specular, nearest(place), 8).a; };
    const float neck = strength({40, -150, 40});
    EXPECT_GT(neck, 0.4F);
    EXPECT_GT(strength({0, -38, 115}), neck + 0.1F) << "nose";
    EXPECT_GT(strength({0, 45, 100}), neck + 0.1F) << "forehead";
    EXPECT_GT(strength({0, -75, 100}), neck + 0.1F) << "lower lip";
}

TEST(HeadMapsTest, hasRoughnessWithinItsRange) {
    const Image& roughness = *head().materials.front().roughness;
    double sum = 0;
    for (int y = 0; y < roughness.height; ++y) {
        for (int x = 0; x < roughness.width; ++x) {
            const float value = texel(roughness, x, y).y;
            // 0.25 to 0.6; rounding to 8 bits moves it by up to 1/510.
            ASSERT_NEAR(value, 0.425F, 0.175F + 1 / 510.0F);
            sum += static_cast<double>(value);
        }
    }
    const glm::vec3 nose = mean_around(roughness, nearest({0, -38, 115}), 8);
    EXPECT_LT(nose.y, sum / (2048.0 * 2048.0) - 0.05) << "the nose is oilier than the rest";
}

} // namespace
