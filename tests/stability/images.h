// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>

#include <gtest/gtest.h>

#include <renderer/gl/context.h>

#include "case.h"

/// Rendering a case and comparing images.
namespace stability {

using renderer::passes::Frame;
using renderer::passes::Shader;

constexpr Shader all_shaders[] = {Shader::no_sss, Shader::ts, Shader::ss_jittered, Shader::ss_full};

/// A test that renders: one OpenGL context for all tests of a suite.
class RenderingTest : public testing::Test {
protected:
    static void SetUpTestSuite() { context.emplace(renderer::gl::Context::headless()); }
    static void TearDownTestSuite() { context.reset(); }

private:
    static std::optional<renderer::gl::Context> context;
};

/// How many random configurations a test tries: SKIN2AFC_STABILITY_COUNT, else the test's own number for
/// everyday use. With SKIN2AFC_STABILITY_ONLY=INDEX a test tries that configuration alone.
struct Indices {
    std::uint64_t first = 0, last = 0; ///< last: one beyond
};
Indices indices(std::uint64_t everyday_count);

Frame rendered(const Case& given, Shader shader);

/// Every value is finite, none is negative.
testing::AssertionResult is_sound(const Frame& frame);
/// Both images are the same to the bit.
testing::AssertionResult is_same(const Frame& a, const Frame& b);
/// Both images differ by at most one of 255 steps in what is displayed, and 1/255 of max(1, light) in linear
/// light. Where a sample's coverage flipped (a vertex is rounded to 1/256 of a pixel, and a change of the
/// last bit can round it to the next), pixels within two of it are left out; more flips than a hundredth of
/// the silhouette's pixels and two fail. Of the other pixels the share `outliers`, and two, may differ more.
testing::AssertionResult is_alike(const Frame& a, const Frame& b, double outliers = 0);

/// The image's mirror image.
Frame flipped(const Frame& frame);

} // namespace stability
