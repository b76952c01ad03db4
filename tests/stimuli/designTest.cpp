// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <support/error.h>

#include "design.h"

namespace {

study::Protocol paper() { return study::read_protocol(PROTOCOLS "/jimenez2009.toml"); }

std::vector<std::string> kept(const std::vector<std::string>& only, const std::string& shard = "") {
    const study::Protocol protocol = paper();
    const auto keep = stimuli::selected(stimuli::selection(only, shard, protocol), protocol);
    std::vector<std::string> names;
    for (const stimuli::Item& item : stimuli::design(protocol)) {
        if (keep.contains(item.name())) {
            names.push_back(item.name());
        }
    }
    return names;
}

/// How many different values the last part (light) or the last two parts (light and camera) of the names
/// take.
std::size_t distinct(const std::vector<std::string>& names, int parts) {
    std::set<std::string> seen;
    for (const std::string& name : names) {
        std::size_t at = name.size();
        for (int part = 0; part < parts; ++part) {
            at = name.rfind('_', at - 1);
        }
        seen.insert(name.substr(at));
    }
    return seen.size();
}

} // namespace

// Section 5.2 of [Jimenez2009]: twelve images for each of four shaders.
TEST(DesignTest, thePaperHas48Images) {
    const auto names = kept({});
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), 48u);
    EXPECT_EQ(names.front(), "no_sss_zoom_000");
    EXPECT_EQ(names.back(), "ss_full_far_150");
}

TEST(DesignTest, imagesOfALightStandTogether) {
    const auto items = stimuli::design(paper());
    int changes = 0;
    for (std::size_t i = 1; i < items.size(); ++i) {
        changes += items[i].azimuth_deg != items[i - 1].azimuth_deg ? 1 : 0;
    }
    EXPECT_EQ(changes, 3);
}

TEST(DesignTest, onlyKeepsWhatIsNamed) {
    EXPECT_EQ(kept({"shader=ts,ss_full", "distance=far", "azimuth=110"}),
              (std::vector<std::string>{"ts_far_110", "ss_full_far_110"}));
}

TEST(DesignTest, onlyRefusesWhatTheProtocolLacks) {
    for (const char* wrong : {"shader=wax", "distance=here", "azimuth=61", "azimuth=", "azimuth=60x",
                              "colour=red", "shader", "shader="}) {
        EXPECT_THROW(kept({wrong}), support::InputError) << wrong;
    }
}

TEST(DesignTest, onlyNamesWhatItTakes) {
    try {
        kept({"shader=references"});
        FAIL();
    } catch (const support::InputError& error) {
        EXPECT_NE(std::string(error.what()).find("ss_full, reference, found"), std::string::npos)
            << error.what();
    }
}

// What is to be split may be any number of images into any number of parts, more than there are images, too.
TEST(DesignTest, shardsAreDisjointAndCompleteAndEvenToOneImage) {
    for (const std::vector<std::string>& only : {std::vector<std::string>{},
                                                 {"shader=ts,ss_full", "distance=far"},
                                                 {"azimuth=60", "shader=no_sss"}}) {
        const auto whole = kept(only);
        for (const int shards : {1, 2, 3, 4, 5, 7, 12, 47, 48, 60}) {
            std::multiset<std::string> all;
            for (int shard = 1; shard <= shards; ++shard) {
                const auto part = kept(only, fmt::format("{}/{}", shard, shards));
                const std::size_t least = whole.size() / static_cast<std::size_t>(shards);
                EXPECT_TRUE(part.size() == least || part.size() == least + 1) << shard << "/" << shards;
                all.insert(part.begin(), part.end());
            }
            EXPECT_EQ(all, std::multiset<std::string>(whole.begin(), whole.end())) << shards;
        }
    }
    for (const char* wrong : {"0/2", "3/2", "1", "1/0", "a/b", "1/2/3", "-1/2"}) {
        EXPECT_THROW(kept({}, wrong), support::InputError) << wrong;
    }
}

// A run of images in the order of lights and views cuts through at most one more of each than it must touch.
TEST(DesignTest, shardsKeepImagesOfOneLightTogether) {
    for (int shard = 1; shard <= 4; ++shard) { // 12 images: a light each
        EXPECT_EQ(distinct(kept({}, fmt::format("{}/4", shard)), 1), 1u);
    }
    for (int shard = 1; shard <= 5; ++shard) { // 9 or 10 images: less than a light, at least two views
        const auto part = kept({}, fmt::format("{}/5", shard));
        EXPECT_LE(distinct(part, 1), 2u);
        EXPECT_LE(distinct(part, 2), 4u);
    }
}

// A protocol need not list the reference; which part an image is in does not depend on what a folder holds.
TEST(DesignTest, theReferenceIsKeptWhereItIsAskedFor) {
    const study::Protocol protocol = paper();
    const auto names = stimuli::selected(
        stimuli::selection({"shader=reference", "distance=far"}, "2/2", protocol), protocol);
    EXPECT_EQ(names, (std::set<std::string>{"reference_far_110", "reference_far_150"}));
}
