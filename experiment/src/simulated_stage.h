// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include <support/random.h>

#include "observer.h"
#include "stage.h"

namespace experiment {

/// A stage without a screen: its clock is arithmetic, its participant an Observer who looks at the pictures
/// as they are shown and presses keys after plausible times. The same seed gives the same session.
class SimulatedStage : public Stage {
public:
    SimulatedStage(Observer observer, std::uint64_t seed);

    double show_after(double duration_s, const Picture& picture) override;
    Press wait_for(std::initializer_list<Key> keys) override;
    StageFacts facts() const override;

private:
    Key choose();

    Observer observer_;
    support::Generator choices_, delays_;
    double now_s_ = 0, onset_s_ = 0;
    Stimulus previous_, current_; // the last two pictures of skin
};

} // namespace experiment
