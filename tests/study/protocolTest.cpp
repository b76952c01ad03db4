// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <stdlib.h>

#include <study/protocol.h>
#include <support/error.h>
#include <support/file.h>

namespace {

namespace fs = std::filesystem;

const fs::path shipped = SKIN2AFC_PROTOCOLS "/jimenez2009.toml";

// The least that a protocol says.
constexpr const char* least = "name = \"least\"\n"
                              "shaders = [\"no_sss\", \"ts\"]\n"
                              "[camera]\n"
                              "distances = [{ name = \"near\", units = 50 }]\n"
                              "[light]\n"
                              "azimuths_deg = [0]\n";

class ProtocolTest : public testing::Test {
protected:
    ProtocolTest() {
        std::string name = (fs::temp_directory_path() / "skin2afc-test-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
    }
    ~ProtocolTest() override { fs::remove_all(folder_); }

    study::Protocol read(const std::string& toml) const {
        std::ofstream(folder_ / "p.toml", std::ios::binary) << toml;
        return study::read_protocol(folder_ / "p.toml");
    }

    /// The error after one text of the least protocol was replaced by another.
    std::string error_with(const std::string& from, const std::string& to) const {
        std::string toml = least;
        toml.replace(toml.find(from), from.size(), to);
        return error(toml);
    }
    std::string error(const std::string& toml) const {
        try {
            read(toml);
        } catch (const support::InputError& input_error) {
            return std::string(input_error.what()).substr(folder_.string().size() + 1);
        }
        return "no error";
    }

    fs::path folder_;
};

// [Jimenez2009, Sec. 5.2 and 5.3].
TEST_F(ProtocolTest, shipsTheDesignOfTheArticle) {
    const study::Protocol protocol = study::read_protocol(shipped);
    EXPECT_EQ(protocol.shaders, (std::vector<std::string>{"no_sss", "ts", "ss_jittered", "ss_full"}));
    EXPECT_EQ(protocol.image.width, 1650);
    EXPECT_EQ(protocol.image.height, 988);
    ASSERT_EQ(protocol.camera.distances.size(), 3U);
    EXPECT_EQ(protocol.camera.distances[0].units, 28);
    EXPECT_EQ(protocol.camera.distances[1].units, 50);
    EXPECT_EQ(protocol.camera.distances[2].units, 132);
    EXPECT_EQ(protocol.camera.head_units, 27);
    EXPECT_EQ(protocol.light.elevation_deg, 45);
    EXPECT_EQ(protocol.light.azimuths_deg, (std::vector<int>{0, 60, 110, 150}));
    EXPECT_EQ(protocol.session.reference, "ts");
    EXPECT_EQ(protocol.session.grey_s, 2);
    EXPECT_EQ(protocol.session.grey_level, 0.5);
    const auto pairs = protocol.session.tests.size() * protocol.camera.distances.size() *
                       protocol.light.azimuths_deg.size() * (protocol.session.both_orders ? 2 : 1);
    EXPECT_EQ(pairs, 72U);
}

TEST_F(ProtocolTest, hasTheFilesDigest) {
    EXPECT_EQ(study::read_protocol(shipped).digest, support::sha256(support::read_text(shipped)));
}

TEST_F(ProtocolTest, needsOnlyNameShadersDistancesAndAzimuths) {
    const study::Protocol protocol = read(least);
    EXPECT_EQ(protocol.session.reference, "ts");
    EXPECT_EQ(protocol.session.tests, std::vector<std::string>{"no_sss"});
    EXPECT_TRUE(protocol.session.both_orders);
    EXPECT_EQ(protocol.image.width, 1650);
    for (const char* field : {"name = \"least\"\n", "shaders = [\"no_sss\", \"ts\"]\n",
                              "distances = [{ name = \"near\", units = 50 }]\n", "azimuths_deg = [0]\n"}) {
        const std::string name = std::string(field).substr(0, std::string(field).find(' '));
        EXPECT_NE(error_with(field, "").find(name + ": expected"), std::string::npos)
            << error_with(field, "");
    }
}

TEST_F(ProtocolTest, namesLineAndFieldOfAWrongType) {
    EXPECT_EQ(error_with("\"least\"", "3"), "p.toml:1: name: expected a text, found 3");
    EXPECT_EQ(error_with("[\"no_sss\", \"ts\"]", "\"ts\""),
              "p.toml:2: shaders: expected an array of texts, found 'ts'");
    EXPECT_EQ(error_with("[{ name = \"near\", units = 50 }]", "[28]"),
              "p.toml:4: camera.distances: expected an array of tables, found the element 28");
    EXPECT_EQ(
        error_with("[0]", "[\"0\"]"),
        "p.toml:6: light.azimuths_deg: expected an array of numbers from 0 to 359, found the element '0'");
}

TEST_F(ProtocolTest, namesLineAndFieldOfAValueOutOfRange) {
    EXPECT_EQ(error_with("units = 50", "units = -1"),
              "p.toml:4: camera.distances[0].units: expected a number from "
              "1e-06 to 1000000000, found -1");
    EXPECT_NE(error_with("units = 50", "units = nan").find("p.toml:4: camera.distances[0].units"),
              std::string::npos);
    EXPECT_NE(error_with("[0]", "[360]").find("p.toml:6: light.azimuths_deg"), std::string::npos);
    EXPECT_NE(error_with("[0]", "[0.5]").find("expected whole degrees, found 0.5"), std::string::npos);
    for (const char* table :
         {"[image]\nwidth = 100000", "[image]\nsamples = 0", "[skin]\ntexture_mix = 2",
          "[bloom]\nstrength = -1", "[ts]\nmap_size = 1", "[ss_full]\nalpha = inf",
          "[ss_jittered]\nunit_mm = 0", "[session]\ngrey_s = -1", "[session]\ngrey_level = 1.1",
          "[model]\nflip_v = 1", "[skin]\nprofile = \"unknown\"", "[session.texts]\nend = 1"}) {
        EXPECT_EQ(error(std::string(least) + table).substr(0, 8), "p.toml:8") << table;
    }
}

TEST_F(ProtocolTest, refusesShadersThatItDoesNotHave) {
    EXPECT_EQ(error_with("\"no_sss\"", "\"magic\""),
              "p.toml:2: shaders: expected a shader (no_sss, ts, ss_jittered, "
              "ss_full, reference), found \"magic\"");
    EXPECT_NE(error(std::string(least) + "[session]\nreference = \"ss_full\"")
                  .find("p.toml:8: session.reference: expected one of the protocol's shaders"),
              std::string::npos);
    EXPECT_NE(error(std::string(least) + "[session]\ntests = [\"ts\"]")
                  .find("p.toml:8: session.tests: expected shaders other than the reference"),
              std::string::npos);
}

TEST_F(ProtocolTest, refusesTheSameTwice) {
    EXPECT_NE(error_with("\"no_sss\"", "\"ts\"").find("p.toml:2: shaders: expected each value once"),
              std::string::npos);
    EXPECT_NE(
        error_with("[0]", "[0, 60, 0]").find("light.azimuths_deg: expected each value once, found 0 twice"),
        std::string::npos);
    EXPECT_NE(
        error_with("50 }", "50 }, { name = \"near\", units = 60 }").find("camera.distances: expected each"),
        std::string::npos);
}

TEST_F(ProtocolTest, refusesNamesThatWouldNotDoInFileNames) {
    for (const char* name : {"", "a/b", "..", "a_b", "a b", "a\\tb"}) {
        EXPECT_NE(error_with("least", name).find("p.toml:1: name: expected 1 to 64 letters and digits"),
                  std::string::npos)
            << name;
        EXPECT_NE(error_with("near", name).find("camera.distances[0].name: expected"), std::string::npos)
            << name;
    }
}

TEST_F(ProtocolTest, refusesFieldsThatItDoesNotKnow) {
    EXPECT_EQ(error(std::string(least) + "elevation = 3").substr(0, 42),
              "p.toml:7: light.elevation: unknown field; ");
    EXPECT_EQ(error(std::string(least) + "[camera2]\nx = 1").substr(0, 31),
              "p.toml:7: camera2: unknown fiel");
}

TEST_F(ProtocolTest, readsTheScreenWhereItIsDescribedWholly) {
    EXPECT_FALSE(read(least).display);
    const std::string table = "[display]\nwidth_mm = 600\nwidth_px = 1920\n";
    const auto display = read(least + table + "distance_mm = 700").display;
    ASSERT_TRUE(display);
    EXPECT_EQ(display->width_mm, 600);
    EXPECT_EQ(display->width_px, 1920);
    EXPECT_EQ(display->distance_mm, 700);
    EXPECT_NE(error(least + table).find("display.distance_mm: expected"), std::string::npos);
    EXPECT_NE(error(least + table + "distance_mm = 0").find("p.toml:10: display.distance_mm: expected"),
              std::string::npos);
}

TEST_F(ProtocolTest, isAPinholeUnlessItNamesALens) {
    EXPECT_EQ(read(least).lens.aperture_mm, 0);
    const study::Protocol protocol = read(least + std::string("[lens]\naperture_mm = 25\nfocus_mm = 400\n"));
    EXPECT_EQ(protocol.lens.aperture_mm, 25);
    EXPECT_EQ(protocol.lens.focus_mm, 400);
    EXPECT_NE(error(least + std::string("[lens]\naperture_mm = -1\n")).find("aperture_mm"),
              std::string::npos);
}

TEST_F(ProtocolTest, namesStimuliAsTheirFilesAre) {
    EXPECT_EQ(study::stimulus_name("ts", "zoom", 0), "ts_zoom_000");
    EXPECT_EQ(study::stimulus_name("ss_full", "far", 110), "ss_full_far_110");
}

TEST_F(ProtocolTest, readsWhatAParticipantMeets) {
    const study::Protocol protocol = read(std::string(least) + R"(
[session]
practice = 3
pause_every = 24
immediate_repeats = false
leave = "alt+x"
[session.texts]
consent = "Möchten Sie?"
[[session.questions]]
id = "age"
kind = "integer"
text = "Alter?"
least = 18
most = 99
[[session.questions]]
id = "art"
kind = "multiple"
text = "Kunst?"
choices = ["Zeichnen", "Foto"]
values = ["drawing", "photography"]
optional = true
)");
    EXPECT_EQ(protocol.session.practice, 3);
    EXPECT_EQ(protocol.session.pause_every, 24);
    EXPECT_FALSE(protocol.session.immediate_repeats);
    EXPECT_EQ(study::text_of(protocol.session.leave), "Alt+X");
    EXPECT_EQ(protocol.session.texts.consent, "Möchten Sie?");
    ASSERT_EQ(protocol.session.questions.size(), 2U);
    EXPECT_EQ(protocol.session.questions[0].most, 99);
    EXPECT_EQ(protocol.session.questions[1].values[1], "photography");
    EXPECT_TRUE(protocol.session.questions[1].optional);
}

TEST_F(ProtocolTest, refusesWordsInBracesThatNothingIsPutInFor) {
    const auto text = [&](const char* key, const char* words) {
        return error(std::string(least) + "[session.texts]\n" + key + " = \"" + words + "\"\n");
    };
    for (const char* key : {"trial", "instructions", "waiting"}) {
        EXPECT_NE(text(key, "Trial {trail}")
                      .find(std::string("session.texts.") + key +
                            ": expected {trial} or {trials} in braces, found \"{trail}\""),
                  std::string::npos)
            << text(key, "Trial {trail}");
    }
    EXPECT_EQ(text("trial", "{trial} of {trials}, {}, {1}"), "no error");
}

TEST_F(ProtocolTest, refusesQuestionsThatCannotBeAskedOrWritten) {
    const auto question = [&](const std::string& fields) {
        return error(std::string(least) + "[[session.questions]]\ntext = \"?\"\n" + fields);
    };
    const auto expect = [](const std::string& message, const std::string& part) {
        EXPECT_NE(message.find(part), std::string::npos) << message;
    };
    expect(question("id = \"a b\"\nkind = \"text\""), "id: expected 1 to 64 letters");
    expect(question("id = \"participant_id\"\nkind = \"text\""), "id: expected");
    expect(question("id = \"a\"\nkind = \"colour\""), "kind: expected");
    expect(question("id = \"a\"\nkind = \"choice\"\nchoices = [\"x\"]"),
           "choices: expected 2 to 9 texts, found 1");
    expect(question("id = \"a\"\nkind = \"choice\"\nchoices = [\"x\", \"y\"]\nvalues = [\"x\"]"),
           "values: expected one a choice, 2, found 1");
    expect(question("id = \"a\"\nkind = \"choice\"\nchoices = [\"x\", \"x\"]"), "each value once");
    // What is not to be known is missing: one answer of several, not one among several.
    expect(question("id = \"a\"\nkind = \"multiple\"\nchoices = [\"x\", \"n/a\"]"), "not \"n/a\"");
    EXPECT_EQ(question("id = \"a\"\nkind = \"choice\"\nchoices = [\"x\", \"n/a\"]"), "no error");
    expect(question("id = \"a\"\nkind = \"multiple\"\nchoices = [\"x;y\", \"z\"]"), "expected no semicolon");
    expect(question("id = \"a\"\nkind = \"integer\"\nleast = 3\nmost = 2"), "most: expected");
    for (const char* leave : {"q", "shift+q", "ctrl+", "ctrl+qq", "ctrl+q+x", "super+q", ""}) {
        expect(error(std::string(least) + "[session]\nleave = \"" + leave + "\""),
               "session.leave: expected ctrl");
    }
}

} // namespace
