// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>

#include <support/error.h>
#include <support/file.h>

#include "figure9.h"
#include "small_set.h"

namespace {

class RenderSetTest : public SmallSetTest {};

} // namespace

TEST_F(RenderSetTest, writesImagesManifestAndContactSheetOnce) {
    EXPECT_EQ(rendered(render()).size(), 48u);
    EXPECT_TRUE(fs::exists(out / "contact_sheet.png"));
    const json written = manifest();
    ASSERT_EQ(written["images"].size(), 48u);
    for (const json& image : written["images"]) {
        EXPECT_EQ(support::sha256_of_file(out / image["file"].get<std::string>()), image["sha256"]);
        EXPECT_TRUE(image["passes_run"].is_array() && image["passes_skipped"].is_array());
    }
    EXPECT_EQ(written["protocol"]["digest"], support::sha256_of_file(protocol_file));
    // 48 images, manifest, contact sheet, and nothing left of writing them.
    EXPECT_EQ(std::distance(fs::directory_iterator(out), fs::directory_iterator()), 50);
    EXPECT_TRUE(rendered(render()).empty());
    EXPECT_EQ(digests().size(), 48u);
}

TEST_F(RenderSetTest, rendersAgainWhatChangedAndNothingElse) {
    render();
    const auto before = digests();
    change_protocol("[bloom]", "[ss_full]\nalpha = 5.5\n\n[bloom]");
    const auto again = rendered(render());
    EXPECT_EQ(again.size(), 12u);
    EXPECT_TRUE(std::all_of(again.begin(), again.end(),
                            [](const auto& name) { return name.starts_with("ss_full"); }));
    const json written = manifest();
    for (const json& image : written["images"]) {
        const json expected = image["shader"] == "ss_full" ? json(5.5) : json("physical");
        EXPECT_EQ(image["parameters"]["method"].value("alpha", json("physical")), expected);
    }

    fs::remove(out / "ts_far_060.png");
    std::ofstream(out / "no_sss_near_110.png", std::ios::app) << "x";
    EXPECT_EQ(rendered(render()), (std::vector<std::string>{"ts_far_060", "no_sss_near_110"}));
    EXPECT_EQ(digests()["ts_far_060.png"], before.at("ts_far_060.png"));
}

TEST_F(RenderSetTest, aSelectionLeavesTheRestForLater) {
    EXPECT_EQ(rendered(render({"shader=ss_jittered", "azimuth=0"})).size(), 3u);
    EXPECT_FALSE(fs::exists(out / "contact_sheet.png"));
    const auto report = render({"distance=far"});
    EXPECT_EQ(rendered(report).size(), 15u);
    EXPECT_EQ(report.missing, 30u);
    EXPECT_EQ(rendered(render()).size(), 30u);
}

TEST_F(RenderSetTest, shardsMakeTheSameBytesAsTheWholeSet) {
    render();
    const auto whole = digests();
    fs::remove_all(out);
    EXPECT_EQ(rendered(render({}, "1/2")).size(), 24u);
    EXPECT_EQ(rendered(render({}, "2/2")).size(), 24u);
    EXPECT_EQ(digests(), whole);
    EXPECT_TRUE(fs::exists(out / "contact_sheet.png"));
}

TEST_F(RenderSetTest, forgetsImagesThatNoLongerBelong) {
    render({"azimuth=0"});
    change_protocol("fov_deg = 20.0", "fov_deg = 21.0");
    render({"azimuth=60"});
    // Images of the old lens are not passed off as images of the new one.
    const json written = manifest();
    EXPECT_EQ(written["images"].size(), 12u);
    for (const json& image : written["images"]) {
        EXPECT_EQ(image["azimuth_deg"], 60);
    }
}

TEST_F(RenderSetTest, aBrokenManifestVouchesForNothing) {
    render({"azimuth=0"});
    std::ofstream(out / "manifest.json") << "{\"images\": [{\"file\": 3}, ";
    EXPECT_EQ(rendered(render({"azimuth=0"})).size(), 12u);
}

TEST_F(RenderSetTest, aPartOfAnotherModelIsNotMixedIn) {
    render();
    const auto before = digests();
    std::fstream buffer(folder / "square.bin", std::ios::in | std::ios::out | std::ios::binary);
    const float wider = -.12f;
    buffer.write(reinterpret_cast<const char*>(&wider), sizeof wider);
    buffer.close();
    EXPECT_THROW(render({"shader=ts"}), support::InputError);
    EXPECT_EQ(digests(), before);
    EXPECT_EQ(rendered(render()).size(), 48u);
}

TEST_F(RenderSetTest, entriesOfAnotherShapeVouchForNothing) {
    render({"azimuth=0"});
    json changed = manifest();
    for (json& image : changed["images"]) {
        image["parameters"] = 3;
    }
    std::ofstream(out / "manifest.json") << changed;
    EXPECT_EQ(rendered(render({"azimuth=0"})).size(), 12u);
}

TEST_F(RenderSetTest, linearImagesAreNeverOlderThanTheirPictures) {
    render_exr();
    const std::string bright = support::sha256_of_file(out / "ts_far_000.exr");
    EXPECT_TRUE(rendered(render_exr()).empty());
    change_protocol("irradiance = [3.0, 3.0, 3.0]", "irradiance = [2.0, 2.0, 2.0]");
    render({"distance=far", "azimuth=0"});
    EXPECT_FALSE(fs::exists(out / "ts_far_000.exr"));
    EXPECT_EQ(rendered(render_exr()).size(), 4u);
    EXPECT_NE(support::sha256_of_file(out / "ts_far_000.exr"), bright);
}

TEST_F(RenderSetTest, whatTheDriverRefusesLeavesTheSetAsItWas) {
    render();
    const auto before = digests();
    change_protocol("samples = 4", "samples = 64");
    EXPECT_THROW(render(), support::InputError);
    EXPECT_EQ(digests(), before);
    fs::remove_all(out);
    EXPECT_THROW(render(), support::InputError);
    EXPECT_FALSE(fs::exists(out));
}

TEST_F(RenderSetTest, coordinatesWithoutAreaAreRefusedBeforeAnythingIsWritten) {
    std::fstream buffer(folder / "square.bin", std::ios::in | std::ios::out | std::ios::binary);
    buffer.seekp(48);
    buffer.write(std::string(32, '\0').data(), 32); // all texture coordinates at one place
    buffer.close();
    EXPECT_THROW(render(), support::InputError);
    EXPECT_FALSE(fs::exists(out));
}

TEST_F(RenderSetTest, aMissingFileIsMissingWhateverTheManifestSays) {
    render();
    fs::remove(out / "ts_zoom_000.png");
    EXPECT_EQ(render({"shader=no_sss"}).missing, 1u);
}

TEST_F(RenderSetTest, theContactSheetFollowsTheOrderOfTheShaders) {
    render();
    const std::string before = support::sha256_of_file(out / "contact_sheet.png");
    change_protocol(R"(shaders = ["no_sss", "ts",)", R"(shaders = ["ts", "no_sss",)");
    EXPECT_TRUE(rendered(render()).empty());
    EXPECT_NE(support::sha256_of_file(out / "contact_sheet.png"), before);
}

TEST_F(RenderSetTest, wrongInputLeavesNothingBehind) {
    stimuli::SetRequest request;
    request.protocol_file = protocol_file;
    request.out = out;
    request.model_file = folder / "missing.glb";
    EXPECT_THROW(stimuli::render_set(request), support::InputError);
    request.model_file = folder / "square.gltf";
    request.only = {"shader=wax"};
    EXPECT_THROW(stimuli::render_set(request), support::InputError);
    request.only = {};
    request.protocol_file = folder / "missing.toml";
    EXPECT_THROW(stimuli::render_set(request), support::InputError);
    EXPECT_FALSE(fs::exists(out));
    std::ofstream(folder / "file") << "in the way";
    request.protocol_file = protocol_file;
    request.out = folder / "file";
    EXPECT_THROW(stimuli::render_set(request), support::InputError);
}

// [Jimenez2009, Figure 9]: over the head's pixels ss_full is nearest to ts, no_sss farthest. From afar, in
// images this small, what the two read from their textures differs by as much as the two screen-space methods
// do.
TEST_F(RenderSetTest, errorsOfTheBuiltInHeadStandInTheOrderOfFigure9) {
    change_protocol("width = 132", "width = 660");
    change_protocol("height = 79", "height = 395");
    change_protocol("map_size = 64", "map_size = 1024");
    stimuli::SetRequest request;
    request.protocol_file = protocol_file;
    request.out = out;
    request.exr = true;
    stimuli::render_set(request);
    const auto views = figure9(study::read_protocol(protocol_file), out);
    ASSERT_EQ(views.size(), 12u);
    for (const ViewErrors& view : views) {
        const bool far = view.view.starts_with("far");
        const double none = view.rmse.at("no_sss");
        EXPECT_TRUE(far ? view.rmse.at("ss_full") < none && view.rmse.at("ss_jittered") < none
                        : view.ordered())
            << view.view << ": no_sss " << none << ", ss_jittered " << view.rmse.at("ss_jittered")
            << ", ss_full " << view.rmse.at("ss_full");
    }
}

// A protocol need not list the reference: it is rendered by name, stays in the manifest, and is no part of
// the set.
TEST_F(RenderSetTest, theReferenceIsRenderedByName) {
    const std::size_t listed = render({"shader=no_sss"}).outcomes.size();
    const stimuli::SetReport report = render({"shader=reference", "distance=far", "azimuth=0"});
    EXPECT_TRUE(fs::exists(out / "reference_far_000.png"));
    EXPECT_GT(report.outcomes.size(), listed);
    const stimuli::SetReport rest = render();
    EXPECT_EQ(rest.missing, 0u);
    for (const stimuli::Outcome& outcome : rest.outcomes) {
        if (outcome.name.starts_with("reference")) {
            EXPECT_EQ(outcome.reason, "not selected") << outcome.name;
        }
    }
    EXPECT_NE(support::read_text(out / "manifest.json").find("reference_far_000.png"), std::string::npos);
}

// The same against the ground truth, from afar, too.
TEST_F(RenderSetTest, shadersStandInTheOrderOfFigure9AgainstTheReference) {
    change_protocol("width = 132", "width = 660");
    change_protocol("height = 79", "height = 395");
    change_protocol(R"(shaders = ["no_sss",)", R"(shaders = ["reference", "no_sss",)");
    change_protocol("azimuths_deg = [0, 60, 110, 150]", "azimuths_deg = [0]");
    change_protocol("[bloom]", "[reference]\nsamples_per_side = 3\ncells_per_sigma = 0.6\n\n[bloom]");
    stimuli::SetRequest request;
    request.protocol_file = protocol_file;
    request.out = out;
    request.exr = true;
    request.only = {"shader=reference,no_sss,ss_jittered,ss_full", "distance=near,far"};
    const stimuli::SetReport report = stimuli::render_set(request);
    EXPECT_TRUE(std::any_of(report.costs.begin(), report.costs.end(),
                            [](const auto& cost) { return cost.first.starts_with("reference"); }));
    study::Protocol two = study::read_protocol(protocol_file);
    std::erase_if(two.camera.distances, [](const study::Distance& d) { return d.name == "zoom"; });
    const auto views = figure9(two, out, "reference");
    ASSERT_EQ(views.size(), 2u);
    for (const ViewErrors& view : views) {
        EXPECT_TRUE(view.ordered()) << view.view << ": no_sss " << view.rmse.at("no_sss") << ", ss_jittered "
                                    << view.rmse.at("ss_jittered") << ", ss_full " << view.rmse.at("ss_full");
    }
    // The reference does not depend on what only OpenGL reads.
    change_protocol("samples = 4", "samples = 1");
    for (const stimuli::Outcome& outcome : stimuli::render_set(request).outcomes) {
        if (outcome.reason != "not selected") {
            EXPECT_EQ(outcome.rendered, !outcome.name.starts_with("reference")) << outcome.name;
        }
    }
}
