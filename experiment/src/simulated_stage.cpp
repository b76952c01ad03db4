// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "simulated_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "interruption.h"

namespace experiment {
namespace {

constexpr double form_s = 5;
constexpr int age_least = 18, age_most = 60; // of those who take part

double logistic(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

/// The log-odds of a probability; infinite for 0 and 1.
double log_odds_of(double probability) { return std::log(probability / (1 - probability)); }

} // namespace

SimulatedStage::SimulatedStage(Observer observer, std::uint64_t seed)
    : observer_(std::move(observer)), seed_(seed), delays_("response times", seed) {
    support::Generator person("participant", seed);
    log_odds_ = observer_.behaviour().spread * person.normal();
    median_s_ =
        observer_.behaviour().median_s * std::exp(observer_.behaviour().median_log_spread * person.normal());
}

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
    if (std::find(keys.begin(), keys.end(), Key::one) != keys.end()) {
        const Key key = choose();
        return {key, now_s_};
    }
    now_s_ += median_s_ * std::exp(observer_.behaviour().log_sd * delays_.normal());
    return {*keys.begin(), now_s_};
}

/// Answer which of the last two pictures is the reference, as likely as the observer tells them apart.
Key SimulatedStage::choose() {
    const bool reference_first = previous_.shader == observer_.reference();
    const std::string& test = reference_first ? current_.shader : previous_.shader;
    const double proportion = observer_.reference_proportion(test, current_.distance, current_.azimuth_deg);

    // Draw from a generator of the pair's own, so that a session that was broken off goes on as it would
    // have.
    support::Generator generator(fmt::format("observer:{}:{}:{}:{}", previous_.shader, current_.shader,
                                             current_.distance, current_.azimuth_deg),
                                 seed_);
    const Behaviour& behaviour = observer_.behaviour();
    const bool lapse = generator.uniform() < behaviour.lapse_rate;
    const double bias = reference_first ? behaviour.interval_bias : -behaviour.interval_bias;
    const double probability = lapse ? 0.5 : logistic(log_odds_of(proportion) + log_odds_ + bias);
    const bool chose_reference = generator.uniform() < probability;
    now_s_ += median_s_ * std::exp(behaviour.log_sd * generator.normal());
    return chose_reference == reference_first ? Key::one : Key::two;
}

FormAnswer SimulatedStage::ask(const Form& form) {
    Interruption::check();
    now_s_ += form_s;
    support::Generator generator("form:" + form.id, seed_);
    FormAnswer answer;
    switch (form.kind) {
    case Form::Kind::notice:
        break;
    case Form::Kind::choice:
        answer.chosen = {form.id == "consent" ? 0 : generator.below(form.choices.size())};
        break;
    case Form::Kind::multiple:
        for (std::size_t i = 0; i < form.choices.size(); ++i) {
            if (generator.below(2) == 1) {
                experiment::choose(form, i, answer);
            }
        }
        if (answer.chosen.empty() && !form.optional) {
            answer.chosen.push_back(generator.below(form.choices.size()));
        }
        break;
    case Form::Kind::integer: {
        const int least = form.id == "age" ? std::clamp(age_least, form.least, form.most) : form.least;
        const int most = form.id == "age" ? std::clamp(age_most, least, form.most) : form.most;
        answer.text = std::to_string(
            least + static_cast<int>(generator.below(static_cast<std::uint64_t>(most - least) + 1)));
        break;
    }
    case Form::Kind::text:
        answer.text = form.optional ? "" : "simulated";
        break;
    }
    return answer;
}

bool SimulatedStage::tell_trouble(const std::string&) {
    return std::exchange(troubled_s_, now_s_) != now_s_; // once at each moment of its clock
}

StageFacts SimulatedStage::facts() const {
    StageFacts facts;
    facts.pacing = "simulated";
    facts.observer = observer_.description();
    facts.observer_digest = observer_.digest();
    return facts;
}

} // namespace experiment
