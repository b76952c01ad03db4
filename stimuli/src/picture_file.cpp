// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "picture_file.h"

#include <OpenImageIO/imageio.h>

#include <support/error.h>
#include <support/file.h>

namespace stimuli {
namespace {

/// Write beside the final place, take the digest, and rename.
std::string write_whole(const std::filesystem::path& file, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                        const void* pixels) {
    support::PendingFile pending(file);
    const std::string path = pending.path().string();
    const auto output = OIIO::ImageOutput::create(path);
    if (!output || !output->open(path, spec) || !output->write_image(type, pixels) || !output->close()) {
        throw support::failure("{}: cannot be written: {}", file.string(),
                               output ? output->geterror() : OIIO::geterror());
    }
    std::string digest = support::sha256_of_file(pending.path());
    pending.commit();
    return digest;
}

} // namespace

std::string write_png(const std::filesystem::path& file, const renderer::passes::Frame& frame) {
    OIIO::ImageSpec spec(frame.width, frame.height, 3, OIIO::TypeDesc::UINT8);
    spec["oiio:ColorSpace"] = "sRGB";
    spec["png:compressionLevel"] = 4; // a quarter of the default's time for a few per cent more bytes
    return write_whole(file, spec, OIIO::TypeDesc::UINT8, frame.srgb.data());
}

std::string write_exr(const std::filesystem::path& file, const renderer::passes::Frame& frame) {
    OIIO::ImageSpec spec(frame.width, frame.height, 4, OIIO::TypeDesc::HALF);
    spec["compression"] = "zip";
    return write_whole(file, spec, OIIO::TypeDesc::FLOAT, frame.linear.data());
}

} // namespace stimuli
