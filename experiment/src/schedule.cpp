// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "schedule.h"

#include <algorithm>
#include <set>

#include <support/error.h>
#include <support/random.h>

namespace experiment {

std::uint64_t default_seed(const study::Protocol& protocol, const std::string& label) {
    return support::seed_of(protocol.name + ":" + label);
}

Schedule make_schedule(const study::Protocol& protocol, std::uint64_t seed) {
    const study::SessionSettings& session = protocol.session;
    if (session.tests.empty()) {
        throw support::input_error("{}: session.tests: expected at least one shader to compare, found none",
                                   protocol.file.string());
    }
    support::Generator generator("trial order", seed);
    Schedule schedule;
    for (const std::string& test : session.tests) {
        for (const study::Distance& distance : protocol.camera.distances) {
            for (const int azimuth_deg : protocol.light.azimuths_deg) {
                const Trial reference_first{session.reference, test, distance.name, azimuth_deg,
                                            session.reference, test};
                Trial test_first = reference_first;
                std::swap(test_first.first, test_first.second);

                // Show both orders, or draw one by lot.
                if (session.both_orders) {
                    schedule.push_back(reference_first);
                    schedule.push_back(test_first);
                } else {
                    schedule.push_back(generator.below(2) == 0 ? reference_first : test_first);
                }
            }
        }
    }
    const auto repeats = [&] {
        return std::adjacent_find(schedule.begin(), schedule.end(), [](const Trial& a, const Trial& b) {
                   return a.same_condition(b);
               }) != schedule.end();
    };
    if (!session.immediate_repeats && schedule.size() == 2 && schedule[0].same_condition(schedule[1])) {
        throw support::input_error(
            "{}: session.immediate_repeats: expected true where there is one condition "
            "alone, found false",
            protocol.file.string());
    }
    // Shuffles without repeats stay equally likely when the others are thrown away: one in e is without.
    do {
        generator.shuffle(schedule);
    } while (!session.immediate_repeats && repeats());
    return schedule;
}

Schedule balanced(Schedule schedule, const std::vector<Schedule>& finished) {
    const auto same_condition = [](const Trial& trial) {
        return [&trial](const Trial& other) { return trial.same_condition(other); };
    };
    for (auto trial = schedule.begin(); trial != schedule.end(); ++trial) {
        // Take each condition where it comes first.
        if (std::find_if(schedule.begin(), trial, same_condition(*trial)) != trial) {
            continue;
        }
        int reference_first = 0; // participants, less those who saw the test first
        for (const Schedule& other : finished) {
            const auto seen = std::find_if(other.begin(), other.end(), same_condition(*trial));
            if (seen != other.end()) {
                reference_first += seen->first == seen->reference ? 1 : -1;
            }
        }
        const bool now = trial->first == trial->reference;
        if ((reference_first > 0 && now) || (reference_first < 0 && !now)) {
            // Exchange the orders of the condition's trials, wherever they stand.
            for (auto other = trial; other != schedule.end(); ++other) {
                if (other->same_condition(*trial)) {
                    std::swap(other->first, other->second);
                }
            }
        }
    }
    return schedule;
}

Schedule practice_trials(const Schedule& schedule, std::size_t count, std::uint64_t seed) {
    support::Generator generator("practice", seed);
    Schedule practice;
    while (practice.size() < count) {
        Schedule all = schedule;
        generator.shuffle(all);
        all.resize(std::min(all.size(), count - practice.size()));
        practice.insert(practice.end(), all.begin(), all.end());
    }
    return practice;
}

std::string text_of(const Trial& trial) {
    return fmt::format("{} {} {} {}", trial.first, trial.second, trial.distance, trial.azimuth_deg);
}

std::vector<Stimulus> stimuli_of(const Schedule& schedule) {
    std::set<Stimulus> stimuli;
    for (const Trial& trial : schedule) {
        stimuli.insert(trial.first_stimulus());
        stimuli.insert(trial.second_stimulus());
    }
    return {stimuli.begin(), stimuli.end()};
}

} // namespace experiment
