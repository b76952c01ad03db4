// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "contact_sheet.h"

#include <cmath>

#include <renderer/optics/color.h>
#include <renderer/scene/image_file.h>
#include <support/error.h>
#include <support/random.h>

#include "picture_file.h"
#include "small_set.h"

namespace {

using renderer::passes::Frame;

class ContactSheetTest : public SmallSetTest {
protected:
    /// One shader, one distance and two lights: two cells of a third of 1200 x 601 pixels.
    study::Protocol two_images() const {
        study::Protocol protocol = study::read_protocol(protocol_file);
        protocol.image.width = 1200;
        protocol.image.height = 601;
        protocol.shaders = {"ts"};
        protocol.camera.distances.resize(1);
        protocol.light.azimuths_deg = {0, 60};
        return protocol;
    }
    static Frame noise(const study::Protocol& protocol, std::string_view name) {
        support::Generator generator(name, 1);
        Frame frame;
        frame.width = protocol.image.width;
        frame.height = protocol.image.height;
        frame.srgb.resize(3 * static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
        for (auto& level : frame.srgb) {
            level = static_cast<std::uint8_t>(generator.below(256));
        }
        return frame;
    }
};

} // namespace

// Lossless and vouched for: the file's bytes have the digest, its pixels are the frame's.
TEST_F(ContactSheetTest, picturesOnTheDiskAreTheFrames) {
    const Frame frame = noise(two_images(), "picture");
    const std::string digest = stimuli::write_png(folder / "picture.png", frame);
    EXPECT_EQ(support::sha256_of_file(folder / "picture.png"), digest);
    const auto image = renderer::scene::read_image(folder / "picture.png");
    EXPECT_EQ(image->width, frame.width);
    EXPECT_EQ(image->channels, 3);
    EXPECT_EQ(image->pixels, frame.srgb);
}

// Against the formula itself: the mean light of 3 x 3 pixels, as the nearest 8-bit level.
TEST_F(ContactSheetTest, thumbnailsAreMeansOfLight) {
    const study::Protocol protocol = two_images();
    stimuli::ContactSheet sheet(protocol);
    const Frame frame = noise(protocol, "left");
    sheet.paste("ts_zoom_000", frame.srgb.data(), 3);
    sheet.paste("ts_zoom_060", frame.srgb.data(), 3);
    sheet.write(folder);
    const auto image = renderer::scene::read_image(folder / "contact_sheet.png");
    // The cells stand at the right and lower edge, each with a gap of 6.
    const int left = image->width - (400 + 6);
    const int top = image->height - (200 + 6);
    const auto level = [](const std::vector<std::uint8_t>& pixels, int width, int x, int y, int c) {
        return pixels[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                           static_cast<std::size_t>(x)) +
                      static_cast<std::size_t>(c)];
    };
    int wrong = 0;
    for (int y = 0; y < 200; ++y) {
        for (int x = 0; x < 400; ++x) {
            for (int c = 0; c < 3; ++c) {
                double light = 0;
                for (int i = 0; i < 9; ++i) {
                    const double signal =
                        level(frame.srgb, frame.width, 3 * x + i % 3, 3 * y + i / 3, c) / 255.0;
                    light += renderer::optics::linear_from_srgb(signal) / 9;
                }
                const auto expected = std::lround(255 * renderer::optics::srgb_from_linear(light));
                const int found = level(image->pixels, image->width, left + x, top + y, c);
                wrong += found != expected ? 1 : 0;
                ASSERT_LE(std::abs(found - expected), 1);
            }
        }
    }
    // The sheet sums in single precision, which now and then decides a tie the other way.
    EXPECT_LE(wrong, 5);
}

TEST_F(ContactSheetTest, imagesFromFilesLookLikeThosePasted) {
    const study::Protocol protocol = two_images();
    stimuli::ContactSheet pasted(protocol);
    stimuli::ContactSheet half(protocol);
    for (const char* name : {"ts_zoom_000", "ts_zoom_060"}) {
        const Frame frame = noise(protocol, name);
        stimuli::write_png(folder / (std::string(name) + ".png"), frame);
        pasted.paste(name, frame.srgb.data(), 3);
    }
    half.paste("ts_zoom_060", noise(protocol, "ts_zoom_060").srgb.data(), 3);
    half.paste("reference_zoom_060", noise(protocol, "no place").srgb.data(), 3);
    pasted.write(folder);
    const std::string expected = support::sha256_of_file(folder / "contact_sheet.png");
    fs::remove(folder / "contact_sheet.png");
    half.write(folder);
    EXPECT_EQ(support::sha256_of_file(folder / "contact_sheet.png"), expected);
}

// A file that is missing, or not of the protocol's size, is refused, and no sheet is left.
TEST_F(ContactSheetTest, filesOfAnotherSizeAreRefused) {
    const study::Protocol protocol = two_images();
    EXPECT_THROW(stimuli::ContactSheet(protocol).write(folder), support::InputError);
    study::Protocol wider = protocol;
    wider.image.width = 1300;
    stimuli::write_png(folder / "ts_zoom_000.png", noise(wider, "wide"));
    EXPECT_THROW(stimuli::ContactSheet(protocol).write(folder), support::InputError);
    EXPECT_FALSE(fs::exists(folder / "contact_sheet.png"));
}

// 20 distances under 360 lights by 4 shaders: as large as those of 48 images, the thumbnails would be 9 GB.
TEST_F(ContactSheetTest, aLargeSetHasASmallSheet) {
    study::Protocol protocol = two_images();
    protocol.shaders = {"no_sss", "ts", "ss_jittered", "ss_full"};
    protocol.camera.distances.assign(20, protocol.camera.distances.front());
    protocol.light.azimuths_deg.resize(360);
    const std::size_t pixels = stimuli::ContactSheet(protocol).pixels();
    EXPECT_LT(pixels, (std::size_t{64} << 20) + 1);
    EXPECT_GT(pixels, std::size_t{20} << 20);
}
