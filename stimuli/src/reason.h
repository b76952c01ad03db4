// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

#include <stimuli/render_set.h>

#include "recipe.h"

namespace stimuli {

constexpr const char* up_to_date = "up to date";
constexpr const char* not_selected = "not selected";

/// Why an image that is selected has to be rendered, or up_to_date. `entry` is what the manifest has of it,
/// or null.
std::string reason_to_render(const std::string& name, const Recipe& recipe,
                             const nlohmann::ordered_json* entry, const SetRequest& request);

} // namespace stimuli
