// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <set>

#include "small_set.h"

namespace {

// The study has 4 lights, 3 distances and 4 shaders.
constexpr int lights = 4, distances = 3, shaders = 4, views = lights * distances, images = views * shaders;

class SharingTest : public SmallSetTest {
protected:
    void SetUp() override {
        SmallSetTest::SetUp();
        change_protocol("shadow_map_size = 4096", "shadow_map_size = 256"); // counts need no large maps
        switches.skip_unlit = false; // the set's square faces the camera: two lights come from behind
    }
    /// How often a word stands in one of the lists of passes of all images.
    int in_manifest(const std::string& list, const std::string& word) const {
        int found = 0;
        const json written = manifest();
        for (const json& image : written["images"]) {
            for (const std::string pass : image[list]) {
                found += pass.starts_with(word) ? 1 : 0;
            }
        }
        return found;
    }
};

} // namespace

TEST_F(SharingTest, whatLightsAndViewsDetermineIsComputedOnce) {
    const auto report = render();
    EXPECT_EQ(runs(report, "shadow map"), lights);
    EXPECT_EQ(runs(report, "lit frame"), views);
    EXPECT_EQ(runs(report, "ts irradiance and blurs"), lights);
    EXPECT_EQ(runs(report, "narrowest Gaussian"), views); // for ts and ss_full
    EXPECT_EQ(runs(report, "ts unwrapping"), 1);
    EXPECT_EQ(runs(report, "composite"), images);
    // The manifest tells the same: each image either ran a node or was left it by an earlier one.
    EXPECT_EQ(in_manifest("passes_run", "shadow map"), lights);
    EXPECT_EQ(in_manifest("passes_skipped", "shadow map: kept"), images - lights);
    EXPECT_EQ(in_manifest("passes_run", "lit frame"), views);
    EXPECT_EQ(in_manifest("passes_skipped", "lit frame: kept"), images - views);
    EXPECT_EQ(in_manifest("passes_skipped", "ts irradiance and blurs: kept"), views - lights);
}

// Not sharing costs a node for each image that needs one, and changes no byte.
TEST_F(SharingTest, withoutSharingEachImageComputesAllItNeeds) {
    render();
    const auto shared = digests();
    fs::remove_all(out);
    renderer::passes::Switches alone = switches;
    alone.share = false;
    const auto report = render_without(alone, true);
    EXPECT_EQ(digests(), shared);
    EXPECT_EQ(runs(report, "shadow map"), images);
    EXPECT_EQ(runs(report, "lit frame"), images);
    EXPECT_EQ(runs(report, "ts irradiance and blurs"), views);
    EXPECT_EQ(in_manifest("passes_skipped", "shadow map: kept"), 0);
}

TEST_F(SharingTest, nothingIsComputedForWhatIsLeftOut) {
    // Without ts no map is unwrapped, without scattering nothing is blurred.
    const auto report = render({"shader=no_sss", "distance=far"});
    EXPECT_EQ(runs(report, "shadow map"), lights);
    EXPECT_EQ(runs(report, "lit frame"), lights);
    EXPECT_EQ(runs(report, "composite"), lights);
    std::set<std::string> nodes;
    for (const auto& [node, cost] : report.costs) {
        nodes.insert(node);
    }
    for (const char* needless : {"ts unwrapping", "ts irradiance and blurs", "narrowest Gaussian",
                                 "ts gather", "ss_full", "ss_jittered", "contact sheet"}) {
        EXPECT_FALSE(nodes.contains(needless)) << needless;
    }
    // A set that is up to date needs no node at all, and no frame waits.
    const auto again = render({"shader=no_sss", "distance=far"});
    for (const char* needless : {"set-up", "shadow map", "lit frame", "composite", "output", "read back"}) {
        EXPECT_EQ(runs(again, needless), 0) << needless;
    }
    EXPECT_EQ(again.most_waiting, 0u);
    // One image more costs its light and its view.
    fs::remove(out / "no_sss_far_110.png");
    const auto one = render({"shader=no_sss"});
    EXPECT_EQ(runs(one, "shadow map"), lights);
    EXPECT_EQ(runs(one, "lit frame"), views - lights + 1);
}

// 48 images in 5 parts: 9 or 10 images, of two lights and four views at most.
TEST_F(SharingTest, shardsShareAndMakeTheSameBytesAsTheWholeSet) {
    render();
    const auto whole = digests();
    for (const int shards : {4, 5}) {
        fs::remove_all(out);
        for (int shard = 1; shard <= shards; ++shard) {
            const auto report = render({}, fmt::format("{}/{}", shard, shards));
            EXPECT_LE(runs(report, "shadow map"), shards == 4 ? 1 : 2);
            EXPECT_LE(runs(report, "lit frame"), shards == 4 ? 3 : 4);
            EXPECT_EQ(runs(report, "composite"), static_cast<int>(rendered(report).size()));
        }
        EXPECT_EQ(digests(), whole) << shards;
    }
}

// Three frames may wait, whether a set is large or small; none where encoding does not overlap rendering.
TEST_F(SharingTest, fewFramesWaitHoweverManyThereAre) {
    EXPECT_EQ(render().most_waiting, 3u);
    const auto whole = digests();
    fs::remove_all(out);
    EXPECT_EQ(render({"distance=far"}).most_waiting, 3u);
    fs::remove_all(out);
    EXPECT_EQ(render_without(switches, false).most_waiting, 0u);
    EXPECT_EQ(digests(), whole);
}
