// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <functional>

#include <gtest/gtest.h>

#include <support/error.h>

#include "fixture.h"
#include "stimulus_set.h"

namespace {

using nlohmann::json;

/// A small set of pictures that a test may spoil.
class StimulusSetTest : public testing::Test {
protected:
    StimulusSetTest() : protocol_(fixture::small_protocol(folder_.path())) {
        manifest_ = fixture::write_stimuli(set_, protocol_);
    }

    experiment::StimulusSet open(int width = 320) const {
        return {set_, experiment::stimuli_of(experiment::make_schedule(protocol_, 1)), width, 200};
    }

    /// The error after the manifest was changed.
    std::string error_with(const std::function<void(json&)>& spoil) {
        json spoilt = manifest_;
        spoil(spoilt);
        fixture::write(set_ / "manifest.json", spoilt.dump());
        return error();
    }

    std::string error(int width = 320) const {
        try {
            open(width);
        } catch (const support::InputError& input_error) {
            return input_error.what();
        }
        return "no error";
    }

    static testing::AssertionResult contains(const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos ? testing::AssertionSuccess()
                                                    : testing::AssertionFailure() << text;
    }

    fixture::TemporaryFolder folder_;
    std::filesystem::path set_ = folder_ / "stimuli";
    study::Protocol protocol_;
    json manifest_;
};

TEST_F(StimulusSetTest, findsThePictureOfEachStimulus) {
    EXPECT_EQ(open().file_of({"ts", "near", 0}).filename(), "ts_near_000.png");
    EXPECT_EQ(open().files().size(), 2U);
}

TEST_F(StimulusSetTest, readsTheProtocolsDigestWhereTheManifestHasOne) {
    json changed = manifest_;
    for (const json& protocol :
         {json({{"digest", "abc"}}), json::array({1}), json("text"), json({{"digest", 3}})}) {
        changed["protocol"] = protocol;
        fixture::write(set_ / "manifest.json", changed.dump());
        const bool has_digest = protocol.is_object() && protocol["digest"].is_string();
        EXPECT_EQ(open().protocol_digest(), has_digest ? "abc" : "") << protocol;
    }
}

TEST_F(StimulusSetTest, refusesAFolderWithoutManifest) {
    std::filesystem::remove(set_ / "manifest.json");
    EXPECT_TRUE(contains(error(), "manifest.json: no such file"));
}

TEST_F(StimulusSetTest, refusesATruncatedManifest) {
    fixture::write(set_ / "manifest.json", manifest_.dump().substr(0, 100));
    EXPECT_TRUE(contains(error(), "manifest.json: expected JSON"));
}

TEST_F(StimulusSetTest, refusesHalfASet) {
    std::filesystem::remove(set_ / "no_sss_near_000.png");
    EXPECT_TRUE(
        contains(error(), "no_sss_near_000.png: expected the picture of the manifest, found no such file"));
    EXPECT_TRUE(contains(error_with([](json& m) { m["images"].erase(0); }), "no_sss_near_000"));
    EXPECT_TRUE(contains(error_with([](json& m) { m["images"] = json::array(); }), "found only 0 others"));
}

TEST_F(StimulusSetTest, refusesAPictureEditedAfterRendering) {
    std::string bytes = fixture::read(set_ / "ts_near_000.png");
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    fixture::write(set_ / "ts_near_000.png", bytes);
    EXPECT_TRUE(contains(error(), "ts_near_000.png: expected the picture of the manifest"));
}

TEST_F(StimulusSetTest, refusesPicturesOfAnotherSizeThanTheProtocols) {
    EXPECT_TRUE(contains(error(640), "expected 640x200 pixels (the protocol's image), found 320x200"));
}

TEST_F(StimulusSetTest, refusesFileNamesThatLeadElsewhere) {
    for (const char* name : {"../ts.png", "/etc/passwd", "a/b.png", "", ".", "..", "a\nb", ".hidden.png"}) {
        EXPECT_TRUE(contains(error_with([&](json& m) { m["images"][1]["file"] = name; }),
                             "images[1].file: expected the name of a file beside the manifest"))
            << name;
    }
}

TEST_F(StimulusSetTest, namesTheFieldOfAWrongType) {
    EXPECT_TRUE(contains(error_with([](json& m) { m["images"] = 3; }), "images: expected an array, found 3"));
    EXPECT_TRUE(contains(error_with([](json& m) { m = json::array(); }), "images: expected a value"));
    EXPECT_TRUE(contains(error_with([](json& m) { m["images"][0] = nullptr; }), "images[0].shader"));
    EXPECT_TRUE(contains(error_with([](json& m) { m["images"][0]["shader"] = 1; }), "images[0].shader"));
    EXPECT_TRUE(contains(error_with([](json& m) { m["images"][0]["azimuth_deg"] = "0"; }), "azimuth_deg"));
    EXPECT_TRUE(contains(error_with([](json& m) { m["images"][0]["azimuth_deg"] = 1e300; }), "azimuth_deg"));
    EXPECT_TRUE(contains(error_with([](json& m) { m["images"][0]["azimuth_deg"] = 0.5; }), "azimuth_deg"));
    EXPECT_TRUE(contains(error_with([](json& m) { m["images"][0]["sha256"] = "abc"; }), "images[0].sha256"));
    EXPECT_TRUE(contains(error_with([](json& m) { m["images"][1] = m["images"][0]; }), "each picture once"));
}

TEST_F(StimulusSetTest, refusesWhatIsNoPicture) {
    fixture::write(set_ / "ts_near_000.png", "not a picture");
    // SHA-256 of the text, by coreutils' sha256sum.
    EXPECT_TRUE(contains(error_with([](json& m) {
                             m["images"][1]["sha256"] =
                                 "bf891ea46ead4993e89aa7da02ab8c23dd50f29e9aae64607105363a5f070e03";
                         }),
                         "ts_near_000.png: expected"));
}

} // namespace
