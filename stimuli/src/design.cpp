// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "design.h"

#include <algorithm>
#include <charconv>
#include <sstream>

#include <fmt/format.h>

#include <support/error.h>

namespace stimuli {
namespace {

template <typename T>
bool contains(const std::vector<T>& values, const T& value) {
    return std::find(values.begin(), values.end(), value) != values.end();
}

std::vector<std::string> distance_names(const study::Protocol& protocol) {
    std::vector<std::string> names;
    for (const study::Distance& distance : protocol.camera.distances) {
        names.push_back(distance.name);
    }
    return names;
}

/// The whole text as a whole number, or -1.
int number_or_negative(const std::string& text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() ? value : -1;
}

} // namespace

std::vector<Item> design(const study::Protocol& protocol) {
    std::vector<Item> items;
    for (const int azimuth : protocol.light.azimuths_deg) {
        for (const study::Distance& distance : protocol.camera.distances) {
            for (const std::string& shader : protocol.shaders) {
                items.push_back({shader, distance, azimuth});
            }
        }
    }
    return items;
}

std::set<std::string> selected(const Selection& selection, const study::Protocol& protocol) {
    study::Protocol asked = protocol;
    if (contains<std::string>(selection.shaders, reference_shader) &&
        !contains<std::string>(asked.shaders, reference_shader)) {
        asked.shaders.emplace_back(reference_shader);
    }
    std::vector<Item> items = design(asked);
    std::erase_if(items, [&](const Item& item) {
        return !((selection.shaders.empty() || contains(selection.shaders, item.shader)) &&
                 (selection.distances.empty() || contains(selection.distances, item.distance.name)) &&
                 (selection.azimuths_deg.empty() || contains(selection.azimuths_deg, item.azimuth_deg)));
    });
    const auto cut = [&](int shard) {
        return items.size() * static_cast<std::size_t>(shard) / static_cast<std::size_t>(selection.shards);
    };
    std::set<std::string> names;
    for (std::size_t i = cut(selection.shard - 1); i < cut(selection.shard); ++i) {
        names.insert(items[i].name());
    }
    return names;
}

Selection selection(const std::vector<std::string>& only, const std::string& shard,
                    const study::Protocol& protocol) {
    Selection result;
    const auto check = [](const auto& known, const auto& value, std::string_view key,
                          const std::string& text) {
        if (!contains(known, value)) {
            throw support::input_error("--only {}: expected one of {}, found \"{}\"", key,
                                       fmt::join(known, ", "), support::one_line(text));
        }
    };
    for (const std::string& argument : only) {
        const std::size_t equals = argument.find('=');
        const std::string key = argument.substr(0, equals);
        if (equals == std::string::npos || (key != "shader" && key != "distance" && key != "azimuth")) {
            throw support::input_error(
                "--only: expected shader=, distance= or azimuth= and values, found \"{}\"",
                support::one_line(argument));
        }
        std::istringstream values(argument.substr(equals + 1) + ",");
        for (std::string value; std::getline(values, value, ',');) {
            if (key == "shader") {
                // The reference may be asked for though the protocol lists it not.
                std::vector<std::string> known = protocol.shaders;
                if (!contains(known, std::string(reference_shader))) {
                    known.emplace_back(reference_shader);
                }
                check(known, value, key, value);
                result.shaders.push_back(value);
            } else if (key == "distance") {
                check(distance_names(protocol), value, key, value);
                result.distances.push_back(value);
            } else {
                const int azimuth = number_or_negative(value);
                check(protocol.light.azimuths_deg, azimuth, key, value);
                result.azimuths_deg.push_back(azimuth);
            }
        }
    }
    if (!shard.empty()) {
        const std::size_t slash = shard.find('/');
        result.shard = number_or_negative(shard.substr(0, slash));
        result.shards = slash == std::string::npos ? -1 : number_or_negative(shard.substr(slash + 1));
        if (result.shard < 1 || result.shards < result.shard) {
            throw support::input_error("--shard: expected I/N with 1 <= I <= N, found \"{}\"",
                                       support::one_line(shard));
        }
    }
    return result;
}

} // namespace stimuli
