// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "compare.h"

#include <fstream>
#include <sstream>

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <support/error.h>
#include <support/file.h>

#include "pictures.h"

namespace {

namespace fs = std::filesystem;
using measure::CompareRequest;

class CompareTest : public testing::Test {
protected:
    CompareTest() {
        fs::create_directories(a());
        fs::create_directories(b());
    }
    fs::path a() const { return folder.path() / "a"; }
    fs::path b() const { return folder.path() / "b"; }
    CompareRequest folders() const {
        CompareRequest request;
        request.image = a();
        request.reference = b();
        return request;
    }
    /// The error without the test's folder; it must leave no file.
    std::string error(const CompareRequest& request) const {
        const auto before = folder.files();
        std::string message = "no error";
        try {
            measure::compare(request);
        } catch (const support::InputError& input_error) {
            message = input_error.what();
        }
        EXPECT_EQ(folder.files(), before);
        const std::string prefix = folder.path().string() + "/";
        for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix)) {
            message.erase(at, prefix.size());
        }
        return message;
    }
    pictures::Folder folder;
};

} // namespace

TEST_F(CompareTest, pairsImagesOfTheSameName) {
    for (const char* name : {"x.png", "y.png"}) {
        pictures::write_square(a() / name, {200, 100, 50});
        pictures::write_square(b() / name, {200, 100, static_cast<std::uint8_t>(name[0] == 'x' ? 50 : 90)});
    }
    pictures::write_square(a() / "contact_sheet.png", {1, 2, 3});
    std::ofstream(b() / "notes.txt") << "no image";
    const auto rows = measure::compare(folders());
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].image, "x.png");
    EXPECT_EQ(rows[0].errors.rmse, 0);
    EXPECT_EQ(rows[1].image, "y.png");
    EXPECT_GT(rows[1].errors.rmse, 0.01);
    EXPECT_EQ(rows[1].errors.object_pixels, 16U * 8);
}

TEST_F(CompareTest, namesAMissingTwin) {
    pictures::write_square(a() / "x.png", {200, 100, 50});
    pictures::write_square(b() / "x.png", {200, 100, 50});
    pictures::write_square(a() / "y.png", {200, 100, 50});
    CompareRequest request = folders();
    request.out = folder.path() / "out" / "deep";
    EXPECT_EQ(error(request), "b: expected y.png, the twin of a/y.png, found none");
    fs::rename(a() / "y.png", b() / "y.png");
    EXPECT_EQ(error(request), "a: expected y.png, the twin of b/y.png, found none");
}

TEST_F(CompareTest, refusesInputsThatCannotBeCompared) {
    CompareRequest request = folders();
    EXPECT_EQ(error(request), "a: expected PNG or OpenEXR images, found none");
    pictures::write_square(a() / "x.png", {200, 100, 50});
    pictures::write_square(b() / "x.png", {200, 100, 50});
    request.reference = b() / "x.png";
    EXPECT_EQ(error(request), "b/x.png: expected a folder as a is one, found a file");
    request = folders();
    request.out = b();
    EXPECT_NE(error(request).find("--out: expected another folder"), std::string::npos);
    std::ofstream(a() / "y.png") << "no image";
    std::ofstream(b() / "y.png") << "no image";
    request.out = folder.path() / "out" / "deep"; // x.png has been measured by then
    EXPECT_EQ(error(request), "a/y.png: expected a PNG or OpenEXR image, found 8 bytes of something else");
    request.image = folder.path() / "none";
    EXPECT_EQ(error(request), "none: no such file");
}

// Eight bits round 0.5 to 188 / 255, which is 0.5029: linear images tell more.
TEST_F(CompareTest, takesLinearImagesWhereBothTwinsHaveOne) {
    for (const fs::path& where : {a(), b()}) {
        pictures::write_square(where / "x.png", {188, 188, 188});
        std::vector<float> values(4 * 32 * 24, 0);
        for (std::size_t i = 0; i < 4 * 32; ++i) {
            values[i] = where == a() ? 0.5f : 0.501f;
        }
        pictures::write_exr(where / "x.exr", 32, 24, 4, values);
    }
    auto rows = measure::compare(folders());
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].image, "x.exr");
    EXPECT_NEAR(rows[0].errors.rmse, 0.001, 1e-7); // floats hold 0.501 to 3e-8
    CompareRequest request = folders();
    request.rules.png_only = true;
    rows = measure::compare(request);
    EXPECT_EQ(rows.at(0).image, "x.png");
    EXPECT_EQ(rows.at(0).errors.rmse, 0);
    fs::remove(b() / "x.exr");
    EXPECT_EQ(measure::compare(folders()).at(0).image, "x.png");
}

TEST_F(CompareTest, aManifestSaysWhichImagesCount) {
    for (const fs::path& where : {a(), b()}) {
        pictures::write_square(where / "x.png", {188, 188, 188});
        std::ofstream(where / "manifest.json") << R"({"images": [{"file": "x.png"}]})";
    }
    pictures::write_square(a() / "left_over.png", {188, 188, 188});
    EXPECT_EQ(measure::compare(folders()).size(), 1U);
    std::ofstream(a() / "manifest.json") << R"({"images": [{"file": "../x.png"}]})";
    EXPECT_NE(error(folders()).find("manifest.json: images[].file: expected a file name"), std::string::npos);
    for (const char* wrong : {"[", "{}", "[]", R"({"images": 1})", R"({"images": [1]})"}) {
        std::ofstream(a() / "manifest.json") << wrong;
        EXPECT_NE(error(folders()).find("a/manifest.json: "), std::string::npos) << wrong;
    }
}

TEST_F(CompareTest, comparesShadersOfOneFolder) {
    for (const char* name : {"reference_near_060.png", "ss_full_near_060.png", "ts_near_060.png"}) {
        pictures::write_square(a() / name, {188, 188, 188});
    }
    CompareRequest request = folders();
    request.reference = a();
    request.rules.against = "reference";
    const auto rows = measure::compare(request);
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].image, "ss_full_near_060.png");
    EXPECT_EQ(rows[0].reference, "reference_near_060.png");
    pictures::write_square(a() / "ts_far_060.png", {188, 188, 188});
    EXPECT_EQ(error(request), "a: expected reference_far_060.png, the twin of a/ts_far_060.png, found none");
}

TEST_F(CompareTest, writesTableAndPictures) {
    pictures::write_square(a() / "x.png", {200, 100, 50});
    pictures::write_square(b() / "x.png", {200, 101, 53});
    CompareRequest request = folders();
    request.out = folder.path() / "out";
    const auto rows = measure::compare(request);
    EXPECT_TRUE(fs::exists(*request.out / "x_flip.png"));
    std::istringstream table(support::read_text(*request.out / "errors.tsv"));
    std::string header, line;
    std::getline(table, header);
    std::getline(table, line);
    EXPECT_EQ(
        header,
        "image\treference\trmse\tpsnr_db\tde2000_mean\tde2000_p95\tssim\tflip\trmse_all\tobject_pixels");
    std::istringstream values(line);
    std::string image, reference, rmse;
    values >> image >> reference >> rmse;
    EXPECT_EQ(std::stod(rmse), rows.at(0).errors.rmse); // to the bit

    // Steps of 0, 1 and 3 out of 255 times 75.
    const auto input = OIIO::ImageInput::open((*request.out / "x_difference.png").string());
    ASSERT_TRUE(input);
    std::vector<std::uint8_t> pixels(3 * 32 * 24);
    ASSERT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, pixels.data()));
    const std::size_t middle = 3 * (12 * 32 + 16);
    EXPECT_EQ(pixels[middle], 0);
    EXPECT_EQ(pixels[middle + 1], 75);
    EXPECT_EQ(pixels[middle + 2], 225);
    EXPECT_EQ(pixels[0], 0);
}

TEST_F(CompareTest, tableForPeopleHasARowAPair) {
    pictures::write_square(a() / "x.png", {200, 100, 50});
    CompareRequest request;
    request.image = request.reference = a() / "x.png";
    const std::string text = measure::to_text(measure::compare(request));
    EXPECT_NE(text.find("x.png  0.000000      inf    0.000    0.000  1.00000  0.000000"), std::string::npos)
        << text;
}
