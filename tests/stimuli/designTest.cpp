// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <set>

#include <gtest/gtest.h>

#include <support/error.h>

#include "design.h"

namespace {

study::Protocol paper() { return study::read_protocol(PROTOCOLS "/jimenez2009.toml"); }

std::vector<std::string> kept(const std::vector<std::string>& only, const std::string& shard = "") {
    const study::Protocol protocol = paper();
    const stimuli::Selection selection = stimuli::selection(only, shard, protocol);
    std::vector<std::string> names;
    for (const stimuli::Item& item : stimuli::design(protocol)) {
        if (selection.keeps(item, protocol)) {
            names.push_back(item.name());
        }
    }
    return names;
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
        EXPECT_NE(std::string(error.what()).find("ss_full, reference, found"), std::string::npos) << error.what();
    }
}

TEST(DesignTest, shardsAreDisjointAndCompleteAndKeepViewsWhole) {
    std::multiset<std::string> all;
    for (const char* shard : {"1/5", "2/5", "3/5", "4/5", "5/5"}) {
        const auto part = kept({}, shard);
        EXPECT_EQ(part.size() % 4, 0u);
        EXPECT_GE(part.size(), 8u);
        all.insert(part.begin(), part.end());
    }
    EXPECT_EQ(all.size(), 48u);
    EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), 48u);
    for (const char* wrong : {"0/2", "3/2", "1", "1/0", "a/b", "1/2/3", "-1/2"}) {
        EXPECT_THROW(kept({}, wrong), support::InputError) << wrong;
    }
}
