// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "schedule.h"

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
    generator.shuffle(schedule);
    return schedule;
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
