// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <stats/figures.h>
#include <stats/study.h>

namespace stats {

/// All answers of one pair of shaders, or those at one distance or one azimuth.
struct GroupRow {
    std::string reference, test;
    std::string by;    ///< "all", "distance" or "azimuth"
    std::string level; ///< "all", the distance's name, or the azimuth in degrees
    Tally tally;
    std::optional<Figures> figures; ///< absent where n is 0
};

/// One row a pair of shaders and group: over all conditions, by distance, by azimuth, in the paper's order. A
/// factor that has answers at one level only gives no rows: they would say again what the row over all says.
std::vector<GroupRow> make_groups(const Study& study, const Settings& settings = {});

/// The rows over all conditions.
std::vector<const GroupRow*> overall(std::span<const GroupRow> groups);

/// The rows as tab-separated text; numbers read back exactly, missing ones are n/a.
std::string to_tsv(std::span<const GroupRow> groups, bool simulated);

} // namespace stats
