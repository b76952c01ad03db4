// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "head_person.h"

#include <numbers>

#include <support/random.h>

#include "head_landmarks.h"

namespace stimuli::head {

Person::Person(const HeadSettings& settings)
    : seed(settings.seed), melanin(static_cast<float>(settings.melanin)),
      age((static_cast<float>(settings.age_years) - 20) / 50), lean_phase(0.4F), tilt_phase(0) {
    wrinkled = std::max(0.2F + 1.35F * age * (0.45F + 0.55F * age) / 0.725F, 0.2F);
    grey = smooth_step(40, 85, static_cast<float>(settings.age_years));
    if (seed == 0) {
        return;
    }
    support::Generator generator("head shape", seed);
    const auto departure = [&] {
        return std::clamp(static_cast<float>(generator.normal()) * 0.6F, -1.2F, 1.2F);
    };
    for (float Person::*field :
         {&Person::nose_width, &Person::nose_length, &Person::mouth_width, &Person::jaw_width,
          &Person::brow_depth, &Person::eye_distance, &Person::cheek_width}) {
        this->*field = departure();
    }
    constexpr float turn = 2 * std::numbers::pi_v<float>;
    lean_phase = turn * static_cast<float>(generator.uniform());
    tilt_phase = turn * static_cast<float>(generator.uniform());
}

glm::vec3 Person::fold(glm::vec3 p) const {
    // Make the two sides differ a little, as all faces do.
    const float face = smooth_step(20, 70, p.z);
    p.x += 0.7F * std::sin(0.021F * p.y + lean_phase) * smooth_step(-160, -110, p.y);
    p.y += 0.6F * (std::sin(0.03F * p.x + tilt_phase) - std::sin(tilt_phase)) * face;

    // Round the fold, so that no crease runs down the midline.
    p.x = std::sqrt(p.x * p.x + 1.5F);
    if (seed == 0) {
        return p;
    }

    // Shift where the mean head's features are looked up, gently enough that no two places meet.
    const auto near = [&](float x, float y, float x_spread, float y_spread) {
        return face * std::exp(-square((p.x - x) / x_spread) - square((p.y - y) / y_spread));
    };
    const float wider = 2.2F * nose_width * near(12, -44, 12, 16) +
                        2.4F * mouth_width * near(26, -72, 15, 12) +
                        1.6F * eye_distance * near(32, 0, 20, 14) +
                        2.2F * cheek_width * near(60, -28, 25, 24) + 3.0F * jaw_width * near(50, -85, 28, 24);
    const float longer = 2.4F * nose_length * near(0, -46, 22, 13);
    const float deeper = 1.5F * brow_depth * near(26, 17, 26, 12);
    return {std::max(p.x - wider, 0.0F), p.y + longer, p.z - deeper};
}

} // namespace stimuli::head
