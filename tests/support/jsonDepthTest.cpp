// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <support/error.h>
#include <support/json_depth.h>

TEST(JsonDepthTest, refusesWhatIsDeeperThan64) {
    const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
    EXPECT_NO_THROW(support::check_json_depth(nested(64), "file"));
    EXPECT_THROW(support::check_json_depth(nested(65), "file"), support::InputError);
    EXPECT_THROW(support::check_json_depth(std::string(100, '{'), "file"), support::InputError);
}

TEST(JsonDepthTest, bracketsInStringsDoNotCount) {
    EXPECT_NO_THROW(support::check_json_depth(
        "[\"" + std::string(100, '[') + "\\\"" + std::string(100, '[') + "\"]", "f"));
    EXPECT_THROW(support::check_json_depth("[\"\\\\\"," + std::string(100, '['), "f"), support::InputError);
}
