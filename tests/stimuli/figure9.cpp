// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "figure9.h"

#include <cmath>
#include <stdexcept>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

namespace {

struct LinearImage {
    int width = 0, height = 0;
    std::vector<float> rgba;
};

LinearImage read(const std::filesystem::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input || input->spec().nchannels != 4) {
        throw std::runtime_error(file.string() + ": no linear image");
    }
    LinearImage image{input->spec().width, input->spec().height, {}};
    image.rgba.resize(4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    if (!input->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, image.rgba.data())) {
        throw std::runtime_error(file.string() + ": " + input->geterror());
    }
    return image;
}

double rmse(const LinearImage& image, const LinearImage& reference) {
    double sum = 0;
    std::size_t pixels = 0;
    for (std::size_t i = 0; i < reference.rgba.size(); i += 4) {
        if (reference.rgba[i + 3] > 0) {
            for (std::size_t c = 0; c < 3; ++c) {
                const double error =
                    static_cast<double>(image.rgba[i + c]) - static_cast<double>(reference.rgba[i + c]);
                sum += error * error / 3;
            }
            ++pixels;
        }
    }
    if (pixels == 0 || image.rgba.size() != reference.rgba.size()) {
        throw std::runtime_error("the images show no head, or differ in size");
    }
    return std::sqrt(sum / static_cast<double>(pixels));
}

} // namespace

bool ViewErrors::ordered() const {
    const double full = rmse.at("ss_full");
    const double jittered = rmse.at("ss_jittered");
    const double none = rmse.at("no_sss");
    return full < jittered && jittered < none && full > 0;
}

std::vector<ViewErrors> figure9(const study::Protocol& protocol, const std::filesystem::path& folder,
                                const std::string& truth) {
    std::vector<ViewErrors> result;
    for (const study::Distance& distance : protocol.camera.distances) {
        for (const int azimuth : protocol.light.azimuths_deg) {
            const auto image = [&](const std::string& shader) {
                return read(folder / (study::stimulus_name(shader, distance.name, azimuth) + ".exr"));
            };
            ViewErrors errors{fmt::format("{}_{:03d}", distance.name, azimuth), {}};
            const LinearImage true_image = image(truth);
            for (const std::string shader : {"no_sss", "ss_jittered", "ss_full"}) {
                errors.rmse[shader] = rmse(image(shader), true_image);
            }
            result.push_back(std::move(errors));
        }
    }
    return result;
}
