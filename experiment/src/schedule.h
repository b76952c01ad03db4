// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include <study/protocol.h>

namespace experiment {

/// One picture of a study, by its factors.
struct Stimulus {
    std::string shader, distance;
    int azimuth_deg = 0;

    auto operator<=>(const Stimulus&) const = default;
};

/// Two shaders compared under one condition, in the order they are shown.
struct Trial {
    std::string reference, test; ///< shaders
    std::string distance;        ///< name of the camera distance
    int azimuth_deg = 0;         ///< of the light
    std::string first, second;   ///< shaders, in the order shown

    Stimulus first_stimulus() const { return {first, distance, azimuth_deg}; }
    Stimulus second_stimulus() const { return {second, distance, azimuth_deg}; }
    bool same_condition(const Trial& other) const {
        return test == other.test && distance == other.distance && azimuth_deg == other.azimuth_deg;
    }
    bool operator==(const Trial&) const = default;
};

/// The trials of a session in the order shown.
using Schedule = std::vector<Trial>;

/// The seed of a session that was given none: it depends on the protocol's name and the participant alone.
std::uint64_t default_seed(const study::Protocol& protocol, const std::string& label);

/// Every test x distance x azimuth of the protocol, in both orders (or, where the protocol asks for one, in
/// an order drawn by lot), shuffled; where the protocol asks for it, again and again until no condition
/// follows itself. The same seed gives the same schedule on every machine. Throws support::InputError where
/// the protocol compares nothing, or has one condition alone that must not follow itself.
Schedule make_schedule(const study::Protocol& protocol, std::uint64_t seed);

/// The session's own schedule, with either order of a pair first as often as the other over a study: where
/// more participants who have finished saw one order of a condition before the other, this one sees the other
/// before. Where they saw both equally often, the schedule stays as it is.
Schedule balanced(Schedule schedule, const std::vector<Schedule>& finished);

/// `count` trials for practice, conditions and orders drawn by lot.
Schedule practice_trials(const Schedule& schedule, std::size_t count, std::uint64_t seed);

/// A trial in words, "FIRST SECOND DISTANCE AZIMUTH_DEG".
std::string text_of(const Trial& trial);

/// The pictures that a schedule shows, each once, sorted.
std::vector<Stimulus> stimuli_of(const Schedule& schedule);

} // namespace experiment
