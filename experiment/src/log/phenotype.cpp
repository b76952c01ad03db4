// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "phenotype.h"

#include <algorithm>
#include <array>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <support/error.h>
#include <support/file.h>

#include "folder_lock.h"

namespace experiment {
namespace {

using nlohmann::ordered_json;

constexpr const char* id_column = "participant_id";
constexpr const char* missing = "n/a";
// What BIDS wants beside the participants' names; all else belongs to a questionnaire.
constexpr std::array<std::string_view, 3> participant_columns{"age", "sex", "handedness"};

bool belongs_to_participants(const std::string& id) {
    return std::find(participant_columns.begin(), participant_columns.end(), id) != participant_columns.end();
}

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, '\t');) {
        cells.push_back(cell);
    }
    return cells;
}

ordered_json description_of(const study::Question& question) {
    ordered_json entry{{"Description", question.text}};
    for (std::size_t i = 0; i < question.choices.size(); ++i) {
        if (question.values[i] == missing) {
            continue; // every reader of BIDS knows it
        }
        entry["Levels"][question.values[i]] = question.choices[i];
    }
    if (question.kind == study::QuestionKind::multiple) {
        entry["Delimiter"] = ";"; // several may apply
    }
    const std::string units = question.id == "age" ? "year" : question.units;
    if (!units.empty()) {
        entry["Units"] = units;
    }
    return entry;
}

/// Describe columns in a JSON file beside their table, as far as it does not describe them yet.
void describe(const fs::path& file, const ordered_json& columns) {
    ordered_json content = ordered_json::object();
    if (fs::exists(file)) {
        content = ordered_json::parse(support::read_text(file), nullptr, false);
        if (!content.is_object()) {
            throw support::input_error("{}: expected a JSON object, found something else or a truncated file",
                                       file.string());
        }
    }
    bool changed = false;
    for (const auto& [column, entry] : columns.items()) {
        if (!content.contains(column)) {
            content[column] = entry;
            changed = true;
        }
    }
    if (changed) {
        support::write_atomically(file, content.dump(2) + "\n");
    }
}

fs::path phenotype_of(const fs::path& study) { return study / "phenotype" / "questionnaire.tsv"; }

} // namespace

ParticipantTable::ParticipantTable(fs::path file) : file_(std::move(file)) {
    if (fs::exists(file_)) {
        std::istringstream stream(support::read_text(file_));
        for (std::string line; std::getline(stream, line);) {
            if (line.ends_with('\r')) {
                line.pop_back();
            }
            if (!line.empty()) {
                rows_.push_back(cells_of(line));
            }
        }
    }
    if (rows_.empty()) {
        rows_.push_back({id_column});
    }
    if (rows_.front().front() != id_column) {
        throw support::input_error("{}:1: expected \"{}\" as the first column, found \"{}\"", file_.string(),
                                   id_column, support::one_line(rows_.front().front()).substr(0, 60));
    }
}

std::size_t ParticipantTable::row_of(const std::string& id) const {
    const auto row =
        std::find_if(rows_.begin() + 1, rows_.end(), [&](const auto& cells) { return cells[0] == id; });
    return row == rows_.end() ? 0 : static_cast<std::size_t>(row - rows_.begin());
}

bool ParticipantTable::note(const std::string& id, const Answers& answers) {
    const auto before = rows_;
    if (!has(id)) {
        rows_.push_back({id});
    }
    for (const auto& [column, value] : answers) {
        std::vector<std::string>& header = rows_.front();
        const auto place = std::find(header.begin(), header.end(), column) - header.begin();
        if (place == std::ssize(header)) {
            header.push_back(column);
        }
        std::vector<std::string>& row = rows_[row_of(id)];
        row.resize(std::max(row.size(), static_cast<std::size_t>(place) + 1), missing);
        row[static_cast<std::size_t>(place)] = value;
    }
    for (std::vector<std::string>& row : rows_) {
        row.resize(std::max(row.size(), rows_.front().size()), missing);
    }
    return rows_ != before;
}

void ParticipantTable::write() const {
    std::string text;
    for (const std::vector<std::string>& row : rows_) {
        text += fmt::format("{}\n", fmt::join(row, "\t"));
    }
    support::write_atomically(file_, text);
}

bool has_answered(const fs::path& study, const std::string& label) {
    return ParticipantTable(phenotype_of(study)).has("sub-" + label);
}

void save_answers(const fs::path& study, const std::string& label,
                  const std::vector<study::Question>& questions, const Answers& answers,
                  const std::function<void()>& tell) {
    // Sort answers and descriptions by the file they belong to.
    Answers about_person, about_study;
    ordered_json person,
        others{{"MeasurementToolMetadata", {{"Description", "Questionnaire before the first session"}}}};
    others[id_column] = {{"Description", "One participant, named by the experimenter"}};
    for (std::size_t i = 0; i < questions.size(); ++i) {
        const bool to_participants = belongs_to_participants(questions[i].id);
        (to_participants ? about_person : about_study).push_back(answers[i]);
        (to_participants ? person : others)[questions[i].id] = description_of(questions[i]);
    }
    // The questionnaire's row comes last: where it is, all is.
    const FolderLock lock = FolderLock::wait(study, tell);
    const std::string id = "sub-" + label;
    ParticipantTable participants(study / "participants.tsv");
    participants.note(id, about_person);
    participants.write();
    describe(study / "participants.json", person);
    support::make_writable_folder(study / "phenotype");
    describe(study / "phenotype" / "questionnaire.json", others);
    ParticipantTable questionnaire(phenotype_of(study));
    questionnaire.note(id, about_study);
    questionnaire.write();
}

} // namespace experiment
