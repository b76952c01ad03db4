// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <study/session.h>

#include "../questionnaire.h"

namespace experiment {

namespace fs = std::filesystem;

/// A table of a study with one row a participant, participant_id first; whoever writes it holds the study's
/// folder.
class ParticipantTable {
public:
    /// Read it; an empty one where there is no file. Throws support::InputError where its first column is
    /// another.
    explicit ParticipantTable(fs::path file);

    bool has(const std::string& id) const { return row_of(id) != 0; }
    /// Note the participant: a new row, or new answers in the old one. Columns that are not there come last;
    /// other columns and rows stay as they are. Returns whether anything changed.
    bool note(const std::string& id, const Answers& answers);
    /// Write it in one step. Throws support::Failure.
    void write() const;

private:
    /// A participant's row; 0, the header's, where there is none.
    std::size_t row_of(const std::string& id) const;

    fs::path file_;
    std::vector<std::vector<std::string>> rows_; // cells; the first row is the header
};

/// Whether a participant has answered the questionnaire.
bool has_answered(const fs::path& study, const std::string& label);

/// Write a participant's answers: age, sex and handedness to participants.tsv, the others to
/// phenotype/questionnaire.tsv, with their descriptions beside them; `tell` says that it waits for another
/// program. Throws support::Failure.
void save_answers(const fs::path& study, const std::string& label,
                  const std::vector<study::Question>& questions, const Answers& answers,
                  const std::function<void()>& tell = {});

} // namespace experiment
