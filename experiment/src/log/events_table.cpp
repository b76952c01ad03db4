// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "events_table.h"

#include <charconv>
#include <filesystem>
#include <optional>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <support/error.h>
#include <support/file.h>

namespace experiment {
namespace {

constexpr std::string_view header = "onset\tduration\ttrial_type\ttrial\tstim_file\n";

// Columns of a log's rows, as log_header has them.
enum Column {
    trial = 0,
    distance = 3,
    azimuth = 4,
    first = 5,
    second = 6,
    response_time = 9,
    onset_first = 10,
    onset_grey = 11,
    onset_second = 12,
    columns = 13
};

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, '\t');) {
        cells.push_back(cell);
    }
    if (cells.size() < columns) {
        throw support::failure("expected a row of a log, found \"{}\"", support::one_line(line));
    }
    return cells;
}

std::optional<double> number(const std::string& cell) {
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    return error == std::errc() && end == cell.data() + cell.size() ? std::optional(value) : std::nullopt;
}

/// The time from one cell to another; n/a where one is.
std::string difference(const std::string& from, const std::string& to) {
    const auto begin = number(from), end = number(to);
    return begin && end ? fmt::format("{:.6f}", *end - *begin) : "n/a";
}

} // namespace

std::string events_of(const std::string& log, const KeptStimuli& kept) {
    std::string events(header);
    std::istringstream lines(log);
    std::string line;
    std::getline(lines, line); // the columns' names
    while (std::getline(lines, line)) {
        const auto row = cells_of(line);
        const auto add = [&](const std::string& onset, const std::string& duration, const char* type,
                             const std::string& file) {
            events += fmt::format("{}\t{}\t{}\t{}\t{}\n", onset, duration, type, row[trial], file);
        };
        const auto stim_file = [&](Column shader) {
            const auto file =
                kept.find({row[shader], row[distance], static_cast<int>(number(row[azimuth]).value_or(-1))});
            return file == kept.end() ? "n/a" : file->second;
        };
        add(row[onset_first], difference(row[onset_first], row[onset_grey]), "first", stim_file(first));
        add(row[onset_grey], difference(row[onset_grey], row[onset_second]), "grey", "n/a");
        add(row[onset_second], row[response_time], "second", stim_file(second));
    }
    return events;
}

void write_events(const SessionLog& log, const KeptStimuli& kept) {
    std::string name = log.path().filename().string();
    const std::string_view suffix = "_beh.tsv";
    name.replace(name.size() - suffix.size(), suffix.size(), "_events.tsv");
    const fs::path file = log.path().parent_path() / name;
    // What someone added by hand is kept.
    if (fs::exists(file) && !support::read_text(file).starts_with(header)) {
        throw support::failure("{}: has other columns than the program's and is left as it is",
                               file.string());
    }
    support::write_atomically(file, events_of(log.content(), kept));
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
