// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "events_table.h"

#include <charconv>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <support/error.h>
#include <support/file.h>

#include "study_folder.h"

namespace experiment {
namespace {

constexpr std::string_view header = "onset\tduration\ttrial_type\ttrial\tstim_file\n";

/// One answered trial of a log, in the columns that log_header names.
struct Row {
    std::string trial, distance, first, second;
    int azimuth_deg = 0;
    double response_s = 0, onset_first_s = 0, onset_grey_s = 0, onset_second_s = 0;
};

Row row_of(const std::string& line) {
    std::istringstream cells(line);
    Row row;
    std::string reference, test, response, chosen;
    cells >> row.trial >> reference >> test >> row.distance >> row.azimuth_deg >> row.first >> row.second >>
        response >> chosen >> row.response_s >> row.onset_first_s >> row.onset_grey_s >> row.onset_second_s;
    if (!cells) {
        throw support::failure("expected a row of a log, found \"{}\"", support::one_line(line));
    }
    return row;
}

} // namespace

std::string events_of(const std::string& log, const fs::path& study, const StimulusSet& stimuli) {
    // BIDS counts paths from the study's stimuli folder.
    const auto stim_file = [&](const Stimulus& stimulus) -> std::string {
        const fs::path kept = StudyFolder::kept_stimulus(stimuli, stimulus);
        return fs::exists(study / kept) ? kept.lexically_relative("stimuli").string() : "n/a";
    };
    std::string events(header);
    std::istringstream lines(log);
    std::string line;
    std::getline(lines, line); // the columns' names
    while (std::getline(lines, line)) {
        const Row row = row_of(line);
        const auto add = [&](double onset_s, double duration_s, const char* type, const std::string& file) {
            events += fmt::format("{:.6f}\t{:.6f}\t{}\t{}\t{}\n", onset_s, duration_s, type, row.trial, file);
        };
        add(row.onset_first_s, row.onset_grey_s - row.onset_first_s, "first",
            stim_file({row.first, row.distance, row.azimuth_deg}));
        add(row.onset_grey_s, row.onset_second_s - row.onset_grey_s, "grey", "n/a");
        add(row.onset_second_s, row.response_s, "second",
            stim_file({row.second, row.distance, row.azimuth_deg}));
    }
    return events;
}

void write_events(const SessionLog& log, const fs::path& study, const StimulusSet& stimuli) {
    std::string name = log.path().filename().string();
    const std::string_view suffix = "_beh.tsv";
    name.replace(name.size() - suffix.size(), suffix.size(), "_events.tsv");
    support::write_atomically(log.path().parent_path() / name, events_of(log.content(), study, stimuli));
}

std::string events_description() {
    const nlohmann::ordered_json columns{
        {"trial_type",
         {{"Description", "What was shown"},
          {"Levels",
           {{"first", "the first picture of a trial, until the space bar"},
            {"grey", "the grey between the pictures"},
            {"second", "the second picture, until the answer"}}}}},
        {"trial", {{"Description", "Number of the trial in the order shown, from 1, as in the log"}}}};
    return columns.dump(2) + "\n";
}

} // namespace experiment
