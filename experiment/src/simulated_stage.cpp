// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "simulated_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "interruption.h"

namespace experiment {
namespace {

// Response times of people are right-skewed: log-normal, with a median that suits looking at two faces.
constexpr double median_response_s = 2.5;
constexpr double log_sd = 0.4;

} // namespace

SimulatedStage::SimulatedStage(Observer observer, std::uint64_t seed)
    : observer_(std::move(observer)), choices_("observer", seed), delays_("response times", seed) {}

double SimulatedStage::show_after(double duration_s, const Picture& picture) {
    now_s_ = std::max(now_s_, onset_s_ + duration_s);
    onset_s_ = now_s_;
    if (const auto* stimulus = std::get_if<Stimulus>(&picture)) {
        previous_ = std::exchange(current_, *stimulus);
    }
    return onset_s_;
}

Press SimulatedStage::wait_for(std::initializer_list<Key> keys) {
    Interruption::check();
    now_s_ += median_response_s * std::exp(log_sd * delays_.normal());
    const bool asked = std::find(keys.begin(), keys.end(), Key::one) != keys.end();
    return {asked ? choose() : *keys.begin(), now_s_};
}

/// Answer which of the last two pictures is the reference, as likely as the observer tells them apart.
Key SimulatedStage::choose() {
    const bool reference_first = previous_.shader == observer_.reference();
    const std::string& test = reference_first ? current_.shader : previous_.shader;
    const double proportion = observer_.reference_proportion(test, current_.distance, current_.azimuth_deg);
    const bool chose_reference = choices_.uniform() < proportion;
    return chose_reference == reference_first ? Key::one : Key::two;
}

StageFacts SimulatedStage::facts() const {
    StageFacts facts;
    facts.pacing = "simulated";
    facts.observer = observer_.description();
    return facts;
}

} // namespace experiment
