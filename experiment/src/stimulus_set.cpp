// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "stimulus_set.h"

#include <algorithm>
#include <cctype>

#include <OpenImageIO/imageio.h>
#include <nlohmann/json.hpp>

#include <support/error.h>
#include <support/file.h>
#include <support/json_depth.h>

namespace experiment {
namespace {

using nlohmann::json;
using support::input_error;

constexpr std::uintmax_t largest_manifest = std::uintmax_t{64} << 20; // bytes

/// What the manifest says of one picture.
struct Entry {
    std::string file, sha256;
};

/// A JSON value for an error message: its type, and its text where that is short.
std::string found(const json& value) {
    if (value.is_structured()) {
        return fmt::format("an {}", value.type_name());
    }
    const std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
    return text.size() <= 60 ? text : fmt::format("a long {}", value.type_name());
}

/// Reads the manifest's fields; an error names file and field.
class ManifestReader {
public:
    explicit ManifestReader(const fs::path& file) : file_(file.string()) {}

    std::map<Stimulus, Entry> read(const std::string& text) const {
        support::check_json_depth(text, file_);
        const json root = json::parse(text, nullptr, false);
        if (root.is_discarded()) {
            throw input_error("{}: expected JSON, found something else or a truncated file", file_);
        }
        const json& images = member(root, "", "images");
        if (!images.is_array()) {
            throw input_error("{}: images: expected an array, found {}", file_, found(images));
        }
        std::map<Stimulus, Entry> entries;
        for (std::size_t i = 0; i < images.size(); ++i) {
            const std::string at = fmt::format("images[{}].", i);
            Stimulus stimulus{text_of(images[i], at, "shader"), text_of(images[i], at, "distance"),
                              azimuth_of(images[i], at)};
            const Entry entry{file_name_of(images[i], at), digest_of(images[i], at)};
            if (!entries.emplace(std::move(stimulus), entry).second) {
                throw input_error("{}: {}file: expected each picture once, found {} again", file_, at,
                                  found(entry.file));
            }
        }
        return entries;
    }

    /// The digest of the protocol in a manifest that read() has accepted.
    static std::string protocol_digest(const std::string& text) {
        const json root = json::parse(text, nullptr, false);
        if (!root.contains("protocol") || !root["protocol"].is_object()) {
            return {};
        }
        const json digest = root["protocol"].value("digest", json());
        return digest.is_string() ? digest.get<std::string>() : std::string();
    }

private:
    const json& member(const json& object, const std::string& at, const char* key) const {
        if (!object.is_object() || !object.contains(key)) {
            throw input_error("{}: {}{}: expected a value, found nothing", file_, at, key);
        }
        return object[key];
    }

    std::string text_of(const json& object, const std::string& at, const char* key) const {
        const json& value = member(object, at, key);
        if (!value.is_string()) {
            throw input_error("{}: {}{}: expected a text, found {}", file_, at, key, found(value));
        }
        return value.get<std::string>();
    }

    int azimuth_of(const json& object, const std::string& at) const {
        const json& value = member(object, at, "azimuth_deg");
        const double degrees = value.is_number() ? value.get<double>() : -1;
        if (!(degrees >= 0 && degrees < 360) || degrees != static_cast<int>(degrees)) {
            throw input_error("{}: {}azimuth_deg: expected whole degrees from 0 to 359, found {}", file_, at,
                              found(value));
        }
        return static_cast<int>(degrees);
    }

    /// A picture lies in the manifest's own folder: a name that leads elsewhere is refused.
    std::string file_name_of(const json& object, const std::string& at) const {
        const std::string name = text_of(object, at, "file");
        const auto leads_elsewhere = [](char c) {
            return c == '/' || c == '\\' || std::iscntrl(static_cast<unsigned char>(c)) != 0;
        };
        if (name.empty() || name.front() == '.' || std::any_of(name.begin(), name.end(), leads_elsewhere)) {
            throw input_error("{}: {}file: expected the name of a file beside the manifest, found {}", file_,
                              at, found(name));
        }
        return name;
    }

    std::string digest_of(const json& object, const std::string& at) const {
        const std::string digest = text_of(object, at, "sha256");
        const auto hexadecimal = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
        if (digest.size() != 64 || !std::all_of(digest.begin(), digest.end(), hexadecimal)) {
            throw input_error("{}: {}sha256: expected 64 hexadecimal digits, found {}", file_, at,
                              found(digest));
        }
        return digest;
    }

    std::string file_;
};

void check_digest(const fs::path& file, const std::string& expected) {
    if (!fs::exists(file)) {
        throw input_error(
            "{}: expected the picture of the manifest, found no such file; render the stimuli again",
            file.string());
    }
    const std::string digest = support::sha256_of_file(file);
    if (digest != expected) {
        throw input_error("{}: expected the picture of the manifest (SHA-256 {}...), found another ({}...); "
                          "render the stimuli again",
                          file.string(), expected.substr(0, 12), digest.substr(0, 12));
    }
}

void check_header(const fs::path& file, int width, int height) {
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input) {
        throw input_error("{}: expected a PNG picture, found: {}", file.string(), OIIO::geterror());
    }
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.width != width || spec.height != height) {
        throw input_error("{}: expected {}x{} pixels (the protocol's image), found {}x{}", file.string(),
                          width, height, spec.width, spec.height);
    }
    if (spec.format != OIIO::TypeDesc::UINT8 || spec.nchannels < 3 || spec.nchannels > 4) {
        throw input_error("{}: expected 8-bit RGB, found {} channels of {}", file.string(), spec.nchannels,
                          spec.format.c_str());
    }
}

} // namespace

StimulusSet::StimulusSet(fs::path folder, const std::vector<Stimulus>& needed, int width, int height)
    : folder_(std::move(folder)) {
    // Read what the manifest says of each picture.
    const fs::path manifest = folder_ / "manifest.json";
    const std::string text = support::read_text(manifest, largest_manifest);
    manifest_digest_ = support::sha256(text);
    const auto entries = ManifestReader(manifest).read(text);
    protocol_digest_ = ManifestReader::protocol_digest(text);

    // Hold each needed picture against it.
    for (const Stimulus& stimulus : needed) {
        const auto entry = entries.find(stimulus);
        if (entry == entries.end()) {
            throw input_error("{}: images: expected the picture {}, found only {} others", manifest.string(),
                              study::stimulus_name(stimulus.shader, stimulus.distance, stimulus.azimuth_deg),
                              entries.size());
        }
        const fs::path file = folder_ / entry->second.file;
        check_digest(file, entry->second.sha256);
        check_header(file, width, height);
        files_.emplace(stimulus, file);
        digests_.emplace(stimulus, entry->second.sha256);
    }
}

} // namespace experiment
