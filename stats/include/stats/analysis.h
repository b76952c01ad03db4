// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <vector>

#include <stats/expertise.h>
#include <stats/groups.h>
#include <stats/quality.h>
#include <stats/study.h>
#include <stats/table.h>

namespace stats {

/// Everything that is said of a study.
struct Analysis {
    Study study;
    Settings settings;
    std::vector<Row> rows;        ///< conditions
    std::vector<GroupRow> groups; ///< shaders: all, by distance, by azimuth
    std::vector<ParticipantQuality> participants;
    std::vector<ExpertiseComparison> expertise;
};

/// Read a study's folder and analyse it; errors as read_study() and read_expertise().
Analysis analyse_study(const std::filesystem::path& folder, const Settings& settings = {},
                       const Leniency& leniency = {});

/// The answers of all participants by the order of the shaders.
OrderTally all_orders(const Analysis& analysis);

} // namespace stats
