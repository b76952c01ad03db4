// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "set/set_bench.h"

#include <sstream>

#include <gmock/gmock.h>

#include <study/protocol.h>
#include <support/error.h>

#include "set/child.h"
#include "set/ways.h"
#include "small_set.h"

namespace {

namespace passes = renderer::passes;
using measure::SetResult;
using measure::SetRow;
using measure::Way;
using testing::HasSubstr;

/// Two shaders at two distances under two lights, of a square: eight images.
class SetBenchTest : public SmallSetTest {
protected:
    static constexpr std::size_t images = 8;

    void SetUp() override {
        SmallSetTest::SetUp();
        change_protocol("shadow_map_size = 4096", "shadow_map_size = 256");
        change_protocol(R"(shaders = ["no_sss", "ts", "ss_jittered", "ss_full"])",
                        R"(shaders = ["no_sss", "ts"])");
        change_protocol(R"(tests = ["no_sss", "ss_jittered", "ss_full"])", R"(tests = ["no_sss"])");
    }
    measure::SetBenchRequest request() const {
        measure::SetBenchRequest result;
        result.protocol_file = protocol_file;
        result.model_file = folder / "square.gltf";
        result.quick = true;
        result.program = SKIN2AFC_PROGRAM;
        return result;
    }
};

const SetRow& row(const SetResult& result, const std::string& name, const std::string& state) {
    for (const SetRow& candidate : result.rows) {
        if (candidate.name == name && candidate.state == state) {
            return candidate;
        }
    }
    throw support::failure("no row {} {}", name, state);
}

int switches_off(const passes::Switches& switches) {
    int off = 0;
    for (const passes::SwitchEntry& entry : passes::switch_list) {
        off += switches.*entry.member ? 0 : 1;
    }
    return off;
}

/// One second with everything on, two without sharing, half a second a separate run.
SetResult figures() {
    SetResult result;
    result.rounds = 3;
    const auto add = [&](const char* name, const char* state, double seconds) {
        SetRow one;
        one.name = name;
        one.state = state;
        one.seconds = seconds;
        one.cpu_seconds = 2 * seconds;
        one.images = 2;
        one.passes = 9;
        one.pixels = 200;
        result.rows.push_back(one);
    };
    add("everything", "on", 1);
    add("share", "off", 2);
    add("program", "one run", 1.25);
    add("program", "a run an image", 10);
    result.rows[1].counts["skin pixels"] = 7;
    return result;
}

} // namespace

TEST_F(SetBenchTest, eachSwitchIsTurnedOffByItself) {
    const auto ways = measure::ways();
    EXPECT_EQ(ways.front().name, "everything");
    EXPECT_EQ(switches_off(ways.front().switches), 0);
    for (const passes::SwitchEntry& entry : passes::switch_list) {
        int found = 0;
        for (const Way& way : ways) {
            if (way.name == entry.name) {
                ++found;
                EXPECT_EQ(way.state, "off");
                EXPECT_FALSE(way.switches.*entry.member);
                EXPECT_EQ(switches_off(way.switches), 1);
                EXPECT_TRUE(way.overlap);
                EXPECT_EQ(way.bound, entry.bound);
            }
        }
        EXPECT_EQ(found, 1) << entry.name;
    }
    const auto off = std::find_if(ways.begin(), ways.end(), [](const Way& way) {
        return way.name == "everything" && way.state == "off";
    });
    ASSERT_NE(off, ways.end());
    EXPECT_EQ(switches_off(off->switches), static_cast<int>(std::size(passes::switch_list)));
    EXPECT_FALSE(off->overlap);
}

// Without sharing, and in a run an image, each image runs all that it needs; nothing else differs.
TEST_F(SetBenchTest, everyWayMakesTheSameImagesByAsManyPassesAsItMust) {
    const SetResult result = measure::run_set(request());
    for (const SetRow& one : result.rows) {
        EXPECT_EQ(one.images, images) << one.name;
        EXPECT_EQ(one.pixels, static_cast<long long>(images) * (132 / 4) * (79 / 4)) << one.name;
        EXPECT_GT(one.seconds, 0) << one.name;
        EXPECT_GT(one.cpu_seconds, 0) << one.name;
    }
    const auto shared = row(result, "everything", "on").passes;
    const auto unshared = row(result, "share", "off").passes;
    // 2 shadow maps in place of 8, 4 lit frames in place of 8, 2 irradiance maps in place of 4.
    EXPECT_EQ(unshared - shared, 6 + 4 + 2);
    EXPECT_EQ(row(result, "overlap", "off").passes, shared);
    EXPECT_EQ(row(result, "program", "one run").passes, shared);
    EXPECT_EQ(row(result, "program", "a run an image").passes, unshared);
}

// A program that shows one light as another stands for a switch that changes what it should not.
TEST_F(SetBenchTest, waysWhoseImagesDifferAreNotTimed) {
    measure::SetBenchRequest wrong = request();
    wrong.program = folder / "program";
    std::ofstream(wrong.program) << "#!/bin/sh\n" SKIN2AFC_PROGRAM " \"$@\" || exit 1\n"
                                 << "cd \"$4\" && sed -i 's/\"sha256\": \"./&0/' manifest.json && "
                                 << "cp no_sss_zoom_000.png no_sss_zoom_060.png\n";
    fs::permissions(wrong.program, fs::perms::owner_all);
    try {
        measure::run_set(wrong);
        FAIL() << "expected a failure";
    } catch (const support::Failure& failure) {
        EXPECT_THAT(failure.what(), HasSubstr("program one run: no_sss_zoom_060.png: expected the image"));
    }
    wrong.program = "/bin/true"; // which makes none
    EXPECT_THROW(measure::run_set(wrong), std::runtime_error);
}

TEST_F(SetBenchTest, aQuickLookIsTheSameProtocolWithFewerAndSmallerImages) {
    measure::SetBenchRequest quick;
    quick.quick = true;
    const auto input = measure::set_input(quick, folder);
    const study::Protocol small = study::read_protocol(input.protocol_file);
    EXPECT_EQ(small.name, "jimenez2009");
    EXPECT_EQ(small.image.width, 412);
    EXPECT_EQ(small.image.height, 247);
    EXPECT_EQ(small.light.shadow_map_size, 1024);
    EXPECT_EQ(small.light.azimuths_deg, (std::vector<int>{0, 60}));
    ASSERT_EQ(small.camera.distances.size(), 2u);
    EXPECT_EQ(small.camera.distances[1].name, "near");
    EXPECT_EQ(small.shaders.size(), 4u);
    EXPECT_EQ(small.bloom.sigma_px, 6.0);
    const study::Protocol whole = study::read_protocol(measure::set_input({}, folder).protocol_file);
    EXPECT_EQ(whole.digest, support::sha256_of_file(PROTOCOLS "/jimenez2009.toml"));
}

TEST_F(SetBenchTest, theTableHasTheColumnsOfTheFormat) {
    std::istringstream lines(measure::set_tsv(figures()));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line,
              "switch\tstate\tseconds\timages\tpasses\tpixels\tseconds_spread\tcpu_seconds\tskin_pixels");
    std::getline(lines, line);
    EXPECT_EQ(line, "everything\ton\t1\t2\t9\t200\t0\t2\tn/a");
    std::getline(lines, line);
    EXPECT_EQ(line, "share\toff\t2\t2\t9\t200\t0\t4\t7");
}

// 1 s over 2 s; separate runs against one run of the program: 1.25 s over 10 s.
TEST_F(SetBenchTest, ratiosStandBesideWhatIsToBeReached) {
    const std::string text = measure::set_text(figures());
    EXPECT_THAT(text, testing::ContainsRegex("share +off .* 0\\.500 +0\\.500 +at most 0\\.5\n"));
    EXPECT_THAT(text, testing::ContainsRegex("a run an image .* 0\\.125 +0\\.125 +at most 0\\.2\n"));
    EXPECT_THAT(text, HasSubstr("under 20 s"));
}

TEST_F(SetBenchTest, aProgramThatFailsSaysWhy) {
    EXPECT_NO_THROW(measure::run_program("/bin/true", {}));
    try {
        measure::run_program("/bin/sh", {"-c", "echo first >&2; echo the reason >&2; exit 3"});
        FAIL() << "expected a failure";
    } catch (const support::Failure& failure) {
        EXPECT_THAT(failure.what(), HasSubstr("found 3: the reason"));
    }
    EXPECT_THROW(measure::run_program(folder / "missing", {}), support::Failure);
}
