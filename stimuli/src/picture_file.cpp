// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "picture_file.h"

#include <OpenImageIO/imageio.h>

#include <support/error.h>
#include <support/file.h>

namespace stimuli {
namespace {

void write(const std::filesystem::path& path, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
           const void* pixels) {
    const auto output = OIIO::ImageOutput::create(path.string());
    if (!output || !output->open(path.string(), spec) || !output->write_image(type, pixels) ||
        !output->close()) {
        throw support::failure("{}: cannot be written: {}", path.string(),
                               output ? output->geterror() : OIIO::geterror());
    }
}

} // namespace

std::string write_png(const std::filesystem::path& file, const renderer::passes::Frame& frame) {
    support::PendingFile pending(file);
    OIIO::ImageSpec spec(frame.width, frame.height, 3, OIIO::TypeDesc::UINT8);
    spec["oiio:ColorSpace"] = "sRGB";
    spec["png:compressionLevel"] = 4; // a quarter of the default's time for a few per cent more bytes
    write(pending.path(), spec, OIIO::TypeDesc::UINT8, frame.srgb.data());
    std::string digest = support::sha256_of_file(pending.path());
    pending.commit();
    return digest;
}

void write_exr(const std::filesystem::path& file, const renderer::passes::Frame& frame) {
    support::PendingFile pending(file);
    OIIO::ImageSpec spec(frame.width, frame.height, 4, OIIO::TypeDesc::HALF);
    spec["compression"] = "zip";
    write(pending.path(), spec, OIIO::TypeDesc::FLOAT, frame.linear.data());
    pending.commit();
}

} // namespace stimuli
