// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/groups.h>

#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <stats/table.h>

#include "answers.h"
#include "labels.h"

namespace stats {
namespace {

enum class By { all, distance, azimuth };

/// A group's key; its condition's other factors are empty.
struct Key {
    By by;
    Condition condition;

    bool operator<(const Key& other) const {
        // Pairs of shaders first, then all, distances, azimuths.
        const Condition pair{condition.reference, condition.test, "", 0},
            other_pair{other.condition.reference, other.condition.test, "", 0};
        if (pair != other_pair) {
            return paper_order(pair, other_pair);
        }
        return by != other.by ? by < other.by : paper_order(condition, other.condition);
    }
};

/// The distances and azimuths at which a pair of shaders has answers.
struct Levels {
    std::set<std::string> distances;
    std::set<double> azimuths_deg;
};

std::map<std::pair<std::string, std::string>, Levels> answered_levels(const Study& study) {
    std::map<std::pair<std::string, std::string>, Levels> result;
    for (const Run& run : study.runs) {
        for (const Trial& trial : run.log.trials) {
            if (run.used && trial.reference_chosen) {
                Levels& levels = result[{trial.condition.reference, trial.condition.test}];
                levels.distances.insert(trial.condition.distance);
                levels.azimuths_deg.insert(trial.condition.azimuth_deg);
            }
        }
    }
    return result;
}

} // namespace

std::vector<GroupRow> make_groups(const Study& study, const Settings& settings) {
    AnswersByKey<Key> counted;
    auto levels = answered_levels(study);
    for (const Run& run : study.runs) {
        if (!run.used) {
            continue;
        }
        for (const Trial& trial : run.log.trials) {
            const Condition& c = trial.condition;
            counted.add({By::all, {c.reference, c.test, "", 0}}, run, trial);
            // A factor with one level would test the same answers again.
            const auto& [distances, azimuths_deg] = levels[{c.reference, c.test}];
            if (distances.size() > 1) {
                counted.add({By::distance, {c.reference, c.test, c.distance, 0}}, run, trial);
            }
            if (azimuths_deg.size() > 1) {
                counted.add({By::azimuth, {c.reference, c.test, "", c.azimuth_deg}}, run, trial);
            }
        }
    }
    const auto keys = counted.keys();
    const auto answers = counted.answers();
    const auto figures = figures_of(answers, settings);
    std::vector<GroupRow> rows;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const auto& [by, condition] = keys[i];
        GroupRow row{condition.reference, condition.test, "all", "all", answers[i].tally, figures[i]};
        if (by == By::distance) {
            row.by = "distance";
            row.level = condition.distance;
        } else if (by == By::azimuth) {
            row.by = "azimuth";
            row.level = exact(condition.azimuth_deg);
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<const GroupRow*> overall(std::span<const GroupRow> groups) {
    std::vector<const GroupRow*> rows;
    for (const GroupRow& group : groups) {
        if (group.by == "all") {
            rows.push_back(&group);
        }
    }
    return rows;
}

std::string to_tsv(std::span<const GroupRow> groups, bool simulated) {
    std::string text =
        "reference\ttest\tgroup\tlevel" + first_columns() + "\tsimulated" + further_columns() + "\n";
    for (const GroupRow& group : groups) {
        text +=
            fmt::format("{}\t{}\t{}\t{}{}\t{}{}\n", group.reference, group.test, group.by, group.level,
                        first_fields(group.tally, group.figures), simulated, further_fields(group.figures));
    }
    return text;
}

} // namespace stats
