// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "observer.h"

#include <algorithm>
#include <array>

#include <support/error.h>
#include <support/file.h>
#include <support/toml_table.h>

namespace experiment {
namespace {

// How many of 32 answers chose `ts`, recovered from the chi-square values of [Jimenez2009, Table II], which
// determine a count up to its complement; the text says that `ts` was preferred.
struct PublishedCounts {
    std::string_view distance;
    int azimuth_deg;
    std::array<int, 3> reference_chosen; // over no_sss, ss_jittered, ss_full
};
constexpr std::array<std::string_view, 3> published_tests{"no_sss", "ss_jittered", "ss_full"};
constexpr int published_answers = 32; // 16 participants, two orders
constexpr std::array<PublishedCounts, 12> published{{
    {"far", 0, {29, 29, 21}},
    {"far", 60, {31, 28, 21}},
    {"far", 110, {30, 27, 17}},
    {"far", 150, {32, 27, 16}},
    {"near", 0, {32, 31, 16}},
    {"near", 60, {32, 31, 17}},
    {"near", 110, {30, 31, 19}},
    {"near", 150, {32, 29, 17}},
    {"zoom", 0, {31, 31, 18}},
    {"zoom", 60, {31, 28, 20}},
    {"zoom", 110, {32, 27, 22}},
    {"zoom", 150, {32, 28, 18}},
}};

} // namespace

Observer::Observer(const std::string& description, const study::Protocol& protocol)
    : description_(description), reference_(protocol.session.reference) {
    const bool from_file = description != "paper" && description != "null";
    digest_ = from_file ? support::sha256_of_file(description) : support::sha256(description);
    if (description == "paper") {
        take_published_counts(protocol);
    } else if (description == "null") {
        rules_.push_back({{}, {}, {}, 0.5});
    } else {
        read_file(protocol);
    }
}

void Observer::take_published_counts(const study::Protocol& protocol) {
    if (reference_ != "ts") {
        throw support::input_error("{}: session.reference: expected \"ts\", the reference of the published "
                                   "counts, found \"{}\"; give --simulate another observer",
                                   protocol.file.string(), reference_);
    }
    for (const PublishedCounts& row : published) {
        for (std::size_t i = 0; i < published_tests.size(); ++i) {
            rules_.push_back({std::string(published_tests[i]), std::string(row.distance), row.azimuth_deg,
                              static_cast<double>(row.reference_chosen[i]) / published_answers});
        }
    }
    for (const std::string& test : protocol.session.tests) {
        for (const study::Distance& distance : protocol.camera.distances) {
            for (const int azimuth_deg : protocol.light.azimuths_deg) {
                if (!find(test, distance.name, azimuth_deg)) {
                    throw support::input_error("{}: expected the conditions of the published counts, found "
                                               "{} at {}, {} degrees; give "
                                               "--simulate another observer",
                                               protocol.file.string(), test, distance.name, azimuth_deg);
                }
            }
        }
    }
}

void Observer::read_file(const study::Protocol& protocol) {
    auto root = support::TomlTable::read(description_);
    rules_.push_back({{}, {}, {}, root.number("default", 0, 1, 0.5)});
    for (support::TomlTable& entry : root.tables("condition")) {
        Rule rule{{}, {}, {}, entry.number("reference_proportion", 0, 1)};
        // Refuse a factor's level that the protocol does not have, for it would silently never match.
        const auto level = [&](std::string_view key, const std::vector<std::string>& known) {
            std::optional<std::string> value;
            if (entry.has(key)) {
                value = entry.text(key);
                if (std::find(known.begin(), known.end(), *value) == known.end()) {
                    throw entry.error(key, fmt::format("expected one of the protocol's ({}), found \"{}\"",
                                                       fmt::join(known, ", "), support::one_line(*value)));
                }
            }
            return value;
        };
        std::vector<std::string> distances;
        for (const study::Distance& distance : protocol.camera.distances) {
            distances.push_back(distance.name);
        }
        rule.test = level("test", protocol.session.tests);
        rule.distance = level("distance", distances);
        if (entry.has("azimuth_deg")) {
            const auto& known = protocol.light.azimuths_deg;
            rule.azimuth_deg = entry.integer("azimuth_deg", 0, 359);
            if (std::find(known.begin(), known.end(), *rule.azimuth_deg) == known.end()) {
                throw entry.error("azimuth_deg", fmt::format("expected one of the protocol's ({}), found {}",
                                                             fmt::join(known, ", "), *rule.azimuth_deg));
            }
        }
        rules_.push_back(std::move(rule));
    }
    behaviour_.lapse_rate = root.number("lapse_rate", 0, 1, behaviour_.lapse_rate);
    behaviour_.interval_bias = root.number("interval_bias", -100, 100, behaviour_.interval_bias);
    behaviour_.spread = root.number("spread", 0, 100, behaviour_.spread);
    support::TomlTable times = root.table("response_time");
    behaviour_.median_s = times.number("median_s", 1e-3, 1e4, behaviour_.median_s);
    behaviour_.log_sd = times.number("log_sd", 0, 5, behaviour_.log_sd);
    behaviour_.median_log_spread = times.number("median_log_spread", 0, 5, behaviour_.median_log_spread);
    root.finish();
}

std::optional<double> Observer::find(const std::string& test, const std::string& distance,
                                     int azimuth_deg) const {
    const auto rule = std::find_if(rules_.rbegin(), rules_.rend(), [&](const Rule& candidate) {
        return candidate.test.value_or(test) == test && candidate.distance.value_or(distance) == distance &&
               candidate.azimuth_deg.value_or(azimuth_deg) == azimuth_deg;
    });
    return rule == rules_.rend() ? std::nullopt : std::optional(rule->reference_proportion);
}

double Observer::reference_proportion(const std::string& test, const std::string& distance,
                                      int azimuth_deg) const {
    const auto proportion = find(test, distance, azimuth_deg);
    if (!proportion) {
        throw support::failure("observer {}: knows nothing of {} at {}, {} degrees", description_, test,
                               distance, azimuth_deg);
    }
    return *proportion;
}

} // namespace experiment
