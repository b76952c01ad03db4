// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <string>

#include <gtest/gtest.h>
#include <stdlib.h>

#include <support/error.h>
#include <support/gnuplot.h>

namespace {

/// What a script's failure says; empty if it draws.
std::string failure_of(const std::string& script) {
    try {
        support::gnuplot_svg(script);
    } catch (const support::Failure& failure) {
        return failure.what();
    }
    return {};
}

TEST(GnuplotTest, drawsAnSvg) {
    const std::string svg =
        support::gnuplot_svg("set terminal svg\nset title 'a title of its own'\nplot x\n");
    EXPECT_NE(svg.find("<svg"), std::string::npos);
    EXPECT_NE(svg.find("a title of its own"), std::string::npos);
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST(GnuplotTest, saysWhatAScriptDoesWrong) {
    const std::string message = failure_of("set terminal svg\nplot 'no such file'\n");
    EXPECT_NE(message.find("no such file"), std::string::npos) << message;
}

TEST(GnuplotTest, refusesAnythingButAnSvg) {
    EXPECT_NE(failure_of("set terminal dumb\nplot x\n"), "");
    EXPECT_NE(failure_of(""), "");
}

TEST(GnuplotTest, namesThePackageOfAMissingProgram) {
    const std::string path = ::getenv("PATH");
    ::setenv("PATH", "/nowhere", 1);
    const std::string message = failure_of("set terminal svg\nplot x\n");
    ::setenv("PATH", path.c_str(), 1);
    EXPECT_NE(message.find("gnuplot-nox"), std::string::npos) << message;
}

} // namespace
