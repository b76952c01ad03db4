// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "sidecar.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <support/error.h>
#include <support/file.h>

namespace stats {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::uintmax_t largest_json = std::uintmax_t{16} << 20;

/// A JSON file's object; an empty one where there is no file.
json read_object(const fs::path& file) {
    std::error_code ignored;
    if (!fs::exists(fs::symlink_status(file, ignored))) {
        return json::object();
    }
    json object;
    try {
        object = json::parse(support::read_text(file, largest_json));
    } catch (const json::exception& error) {
        // Leave out the library's "[json.exception...] " in front of the message.
        const std::string_view message = error.what();
        throw support::input_error("{}: expected JSON, found: {}", file.string(),
                                   message.substr(message.find("] ") + 2));
    }
    if (!object.is_object()) {
        throw support::input_error("{}: expected a JSON object, found {}", file.string(), object.type_name());
    }
    return object;
}

/// A field's value where the object has it; throws InputError when it is of another type.
template <typename T>
std::optional<T> field(const json& object, const fs::path& file, const char* key, std::string_view expected,
                       bool (json::*is_expected)() const noexcept) {
    const auto found = object.find(key);
    if (found == object.end()) {
        return std::nullopt;
    }
    if (!((*found).*is_expected)()) {
        // An array or object may be too deep to be shown.
        throw support::input_error("{}: {}: expected {}, found {}", file.string(), key, expected,
                                   found->is_structured() ? std::string(found->type_name())
                                                          : found->dump().substr(0, 60));
    }
    return found->get<T>();
}

bool simulated_in(const json& object, const fs::path& file) {
    return field<bool>(object, file, "Simulated", "true or false", &json::is_boolean).value_or(false);
}

std::optional<std::string> text(const json& object, const fs::path& file, const char* key) {
    return field<std::string>(object, file, key, "a text", &json::is_string);
}

std::optional<std::int64_t> whole(const json& object, const fs::path& file, const char* key,
                                  std::int64_t least) {
    const std::string expected = fmt::format("a whole number from {} on", least);
    const auto value = field<std::int64_t>(object, file, key, expected, &json::is_number_unsigned);
    if (value && *value < least) {
        throw support::input_error("{}: {}: expected {}, found {}", file.string(), key, expected, *value);
    }
    // More than any session holds; sums of such numbers could overflow.
    constexpr std::int64_t most = 1'000'000'000;
    if (value && *value > most) {
        throw support::input_error("{}: {}: expected {} and at most {}, found {}", file.string(), key,
                                   expected, most, *value);
    }
    return value;
}

/// What names the folder of the study's copies of the pictures; empty for what is no SHA-256.
std::string stimuli_digits(const json& object, const fs::path& file) {
    constexpr std::size_t digest_length = 64, kept = 12;
    const std::string digest = text(object, file, "StimuliManifestDigest").value_or("");
    const bool whole_digest =
        digest.size() == digest_length && digest.find_first_not_of("0123456789abcdef") == std::string::npos;
    return whole_digest ? digest.substr(0, kept) : "";
}

} // namespace

Description read_description(const fs::path& file) {
    const json object = read_object(file);
    return {text(object, file, "Name"), simulated_in(object, file)};
}

Sidecar read_sidecar(const fs::path& file) {
    const json object = read_object(file);
    Sidecar sidecar;
    sidecar.trials_planned = whole(object, file, "TrialsPlanned", 1);
    if (const auto found = object.find("DroppedFrames"); found != object.end() && *found != "n/a") {
        sidecar.dropped_frames = whole(object, file, "DroppedFrames", 0);
    }
    sidecar.protocol = text(object, file, "Protocol").value_or("");
    sidecar.protocol_digest = text(object, file, "ProtocolDigest").value_or("");
    sidecar.stimuli = stimuli_digits(object, file);
    sidecar.simulated = simulated_in(object, file);
    return sidecar;
}

} // namespace stats
