// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include <support/random.h>

#include "observer.h"
#include "stage.h"

namespace experiment {

/// A stage without a screen: its clock is arithmetic, its participant an Observer who looks at the pictures
/// as they are shown and presses keys after plausible times. The same seed gives the same participant, who
/// answers a pair alike whatever was shown before.
class SimulatedStage : public Stage {
public:
    SimulatedStage(Observer observer, std::uint64_t seed);

    double show_after(double duration_s, const Picture& picture) override;
    Press wait_for(std::initializer_list<Key> keys) override;
    /// Agrees to the first of several choices where that is consent; else draws answers from those allowed.
    FormAnswer ask(const Form& form) override;
    /// Tries once more.
    bool tell_trouble(const std::string& message) override;
    StageFacts facts() const override;
    double now_s() const override { return now_s_; }

private:
    Key choose();

    Observer observer_;
    std::uint64_t seed_;
    support::Generator delays_;
    double log_odds_ = 0, median_s_; // of this participant
    double now_s_ = 0, onset_s_ = 0, troubled_s_ = -1;
    Stimulus previous_, current_; // the last two pictures of skin
};

} // namespace experiment
