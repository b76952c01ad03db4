// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <filesystem>
#include <fstream>
#include <functional>

#include <gtest/gtest.h>
#include <stdlib.h>

#include <support/toml_table.h>

namespace {

namespace fs = std::filesystem;
using support::TomlTable;

class TomlTableTest : public testing::Test {
protected:
    TomlTableTest() {
        std::string name = (fs::temp_directory_path() / "skin2afc-test-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
    }
    ~TomlTableTest() override { fs::remove_all(folder_); }

    TomlTable read(const std::string& toml) const {
        std::ofstream(folder_ / "t.toml", std::ios::binary) << toml;
        return TomlTable::read(folder_ / "t.toml");
    }
    /// The error's text after the folder's name.
    std::string error(const std::string& toml, const std::function<void(TomlTable&)>& use) const {
        try {
            TomlTable table = read(toml);
            use(table);
        } catch (const support::InputError& input_error) {
            return std::string(input_error.what()).substr(folder_.string().size() + 1);
        }
        return "no error";
    }

    fs::path folder_;
};

TEST_F(TomlTableTest, readsEachType) {
    TomlTable table = read("n = 1.5\ni = 3\nb = true\nt = \"x\"\nv = [1, 2.5]\nw = [\"a\", \"b\"]");
    EXPECT_EQ(table.number("n", 0, 2), 1.5);
    EXPECT_EQ(table.number("i", 0, 3), 3);
    EXPECT_EQ(table.integer("i", 3, 3), 3);
    EXPECT_TRUE(table.boolean("b"));
    EXPECT_EQ(table.text("t"), "x");
    EXPECT_EQ(table.word("t", {"x", "y"}), "x");
    EXPECT_EQ(table.numbers("v", 2, 0, 3), (std::vector<double>{1, 2.5}));
    EXPECT_EQ(table.texts("w"), (std::vector<std::string>{"a", "b"}));
    EXPECT_NO_THROW(table.finish());
}

TEST_F(TomlTableTest, fallsBackWhereAFieldIsAbsent) {
    TomlTable table = read("");
    EXPECT_EQ(table.number("n", 0, 1, 0.5), 0.5);
    EXPECT_EQ(table.text("t", "x"), "x");
    EXPECT_FALSE(table.has("n"));
    EXPECT_EQ(table.table("sub").integer("i", 0, 9, 4), 4);
    EXPECT_TRUE(table.tables("many").empty());
}

TEST_F(TomlTableTest, namesFileLineFieldExpectationAndFinding) {
    EXPECT_EQ(error("\nn = 3", [](TomlTable& t) { t.number("n", 0, 1); }),
              "t.toml:2: n: expected a number from 0 to 1, found 3");
    EXPECT_EQ(error("", [](TomlTable& t) { t.number("n", 0, 1); }),
              "t.toml: n: expected a number from 0 to 1, found nothing");
    EXPECT_EQ(error("[s]\ni = 1.5", [](TomlTable& t) { t.table("s").integer("i", 0, 1); }),
              "t.toml:2: s.i: expected a whole number from 0 to 1, found 1.5");
    EXPECT_EQ(error("[[a]]\n[[a]]\nb = 1", [](TomlTable& t) { t.tables("a").at(1).boolean("b"); }),
              "t.toml:3: a[1].b: expected true or false, found 1");
    EXPECT_EQ(error("t = []", [](TomlTable& t) { t.text("t"); }),
              "t.toml:1: t: expected a text, found an array");
    EXPECT_EQ(error("t = \"z\"",
                    [](TomlTable& t) {
                        t.word("t", {"x", "y"});
                    }),
              "t.toml:1: t: expected one of x, y, found \"z\"");
    EXPECT_EQ(error("v = [1, \"a\"]", [](TomlTable& t) { t.numbers("v", 2, 0, 1); }),
              "t.toml:1: v: expected an array of 2 numbers from 0 to 1, found the element 'a'");
    EXPECT_EQ(error("v = [1]", [](TomlTable& t) { t.numbers("v", 2, 0, 1); }),
              "t.toml:1: v: expected an array of 2 numbers from 0 to 1, found 1 elements");
    EXPECT_EQ(error("s = 1", [](TomlTable& t) { t.table("s"); }), "t.toml:1: s: expected a table, found 1");
}

TEST_F(TomlTableTest, refusesNumbersThatAreNone) {
    for (const char* value : {"nan", "inf", "-inf", "\"1\"", "true", "1e400"}) {
        EXPECT_NE(error(std::string("n = ") + value, [](TomlTable& t) { t.number("n", -1e300, 1e300); }),
                  "no error")
            << value;
    }
    EXPECT_NE(error("i = 99999999999", [](TomlTable& t) { t.integer("i", 0, 2147483647); }), "no error");
}

TEST_F(TomlTableTest, refusesFieldsThatNothingRead) {
    EXPECT_EQ(error("a = 1\nb = 2",
                    [](TomlTable& t) {
                        t.integer("a", 0, 9);
                        t.finish();
                    }),
              "t.toml:2: b: unknown field; expected one of a");
    EXPECT_EQ(error("[s]\nb = 2",
                    [](TomlTable& t) {
                        t.table("s").integer("a", 0, 9, 1);
                        t.finish();
                    }),
              "t.toml:2: s.b: unknown field; expected one of a");
}

TEST_F(TomlTableTest, refusesWhatIsNoToml) {
    const auto nothing = [](TomlTable&) {};
    EXPECT_EQ(error("a = ", nothing).substr(0, 24), "t.toml:1: expected TOML,");
    EXPECT_NE(error("a = 1\na = 2", nothing), "no error");
    EXPECT_NE(error(std::string("a = \"\0\"", 7), nothing), "no error");
    EXPECT_NE(error("\xff\xfe", nothing), "no error");
    EXPECT_NE(error("a = " + std::string(100000, '['), nothing), "no error");
    EXPECT_THROW(TomlTable::read(folder_ / "missing.toml"), support::InputError);
    EXPECT_THROW(TomlTable::read(folder_), support::InputError);
}

} // namespace
