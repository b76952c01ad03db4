// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>
#include <vector>

#include <stats/analysis.h>

#include "pictures.h"

namespace stats {

/// The parts of the report, as HTML without their headings.
std::string table2_html(const Analysis& analysis);
std::string shaders_html(const Analysis& analysis);
std::string conditions_html(const Analysis& analysis);
std::string order_html(const Analysis& analysis);
std::string response_times_html(const Analysis& analysis);
std::string expertise_html(const Analysis& analysis);
std::string quality_html(const Analysis& analysis);
std::string methods_html(const Analysis& analysis);
std::string stimuli_html(const Analysis& analysis,
                         const std::vector<std::optional<ConditionPictures>>& pictures,
                         const std::optional<std::string>& contact_sheet);

} // namespace stats
