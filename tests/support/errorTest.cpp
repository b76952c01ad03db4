// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <support/error.h>

namespace {

TEST(ErrorTest, fillsInItsArguments) {
    EXPECT_STREQ(support::input_error("{}: expected {}, found {}", "f.toml", 1, 2).what(),
                 "f.toml: expected 1, found 2");
    EXPECT_STREQ(support::failure("{}%", 50).what(), "50%");
}

TEST(ErrorTest, staysOneVisibleLine) {
    EXPECT_EQ(support::one_line("a\nb"), "a b");
    EXPECT_EQ(support::one_line("\x1b[31mred\x7f\t"), "\\x1b[31mred\\x7f\\x09");
    EXPECT_EQ(support::one_line("60\xc2\xb0"), "60\xc2\xb0"); // UTF-8 stays
}

} // namespace
