// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/expertise.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

#include <fmt/format.h>

#include <stats/figures.h>
#include <support/error.h>
#include <support/file.h>

#include "labels.h"
#include "outcome.h"

namespace stats {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 9> words{
    "expertise", "expert", "experience", "experienced", "graphics", "art", "arts", "drawing", "photography"};
constexpr std::array<std::string_view, 7> none{"no", "none", "false", "0", "n", "f", "never"};
constexpr std::uintmax_t largest_table = std::uintmax_t{64} << 20;

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    for (std::size_t start = 0;;) {
        const auto end = text.find(separator, start);
        parts.push_back(text.substr(start, end - start));
        if (end == std::string::npos) {
            return parts;
        }
        start = end + 1;
    }
}

/// Without blanks at either end.
std::string trimmed(const std::string& text) {
    const auto start = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
    return start == std::string::npos ? "" : text.substr(start, last - start + 1);
}

/// Whether an answer in small letters denies: "no", "none of it", but not "nothing but art".
bool denies(const std::string& answer) {
    const std::string first = answer.substr(0, answer.find_first_of(" ,;"));
    return std::find(none.begin(), none.end(), first) != none.end();
}

bool asks_for_expertise(const std::string& column) {
    std::string spaced = lower(column);
    std::replace_if(
        spaced.begin(), spaced.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, ' ');
    const auto parts = split(spaced, ' ');
    return std::any_of(words.begin(), words.end(), [&](std::string_view word) {
        return std::find(parts.begin(), parts.end(), word) != parts.end();
    });
}

/// The questions of one table.
void add_questions(std::vector<ExpertiseQuestion>& questions, const fs::path& study, const fs::path& file) {
    std::string text = support::read_text(file, largest_table);
    std::erase(text, '\r');
    std::vector<std::string> columns;
    std::vector<ExpertiseQuestion> found;
    std::set<std::string> seen;
    std::size_t number = 0;
    for (const std::string& line : split(text, '\n')) {
        const auto fields = split(line, '\t');
        if (++number == 1) {
            columns = fields;
            if (columns.front() != "participant_id") {
                throw support::input_error(
                    "{}:1: expected \"participant_id\" as the first column, found \"{}\"", file.string(),
                    columns.front().substr(0, 60));
            }
            for (const std::string& column : columns) {
                found.push_back({column, file.lexically_relative(study).string(), {}});
            }
            continue;
        }
        if (line.empty()) {
            continue;
        }
        if (fields.size() != columns.size()) {
            throw support::input_error("{}:{}: expected {} fields separated by tabs, found {}", file.string(),
                                       number, columns.size(), fields.size());
        }
        if (!seen.insert(fields[0]).second) {
            throw support::input_error("{}:{}: expected a participant_id of its own, found {} again",
                                       file.string(), number, fields[0].substr(0, 60));
        }
        const std::string label = fields[0].starts_with("sub-") ? fields[0].substr(4) : fields[0];
        for (std::size_t i = 1; i < fields.size(); ++i) {
            const std::string answer = trimmed(lower(fields[i]));
            if (answer != "n/a" && !answer.empty()) {
                found[i].by_participant[label] = !denies(answer);
            }
        }
    }
    for (ExpertiseQuestion& question : found) {
        if (asks_for_expertise(question.column) && !question.by_participant.empty()) {
            questions.push_back(std::move(question));
        }
    }
}

/// A group's errors and the participants' proportions of them.
struct Group {
    GroupErrors errors;
    std::vector<double> proportions;

    void add(const ParticipantQuality& one) {
        ++errors.participants;
        errors.errors += one.errors;
        errors.answers += one.answers();
        proportions.push_back(static_cast<double>(one.errors) / static_cast<double>(one.answers()));
    }

    GroupErrors summary() {
        std::sort(proportions.begin(), proportions.end());
        errors.median = quantile(proportions, 0.5);
        return errors;
    }
};

} // namespace

std::vector<ExpertiseQuestion> read_expertise(const fs::path& study) {
    std::vector<ExpertiseQuestion> questions;
    std::error_code ignored;
    if (fs::exists(study / "participants.tsv", ignored)) {
        add_questions(questions, study, study / "participants.tsv");
    }
    std::set<fs::path> tables;
    for (fs::directory_iterator i(study / "phenotype", ignored), end; !ignored && i != end;
         i.increment(ignored)) {
        const std::string name = i->path().filename().string();
        if (name.ends_with(".tsv") && !name.starts_with('.')) {
            tables.insert(i->path());
        }
    }
    for (const fs::path& table : tables) {
        add_questions(questions, study, table);
    }
    return questions;
}

std::vector<ExpertiseComparison> compare_expertise(std::span<const ExpertiseQuestion> questions,
                                                   std::span<const ParticipantQuality> participants) {
    std::vector<ExpertiseComparison> result;
    for (const ExpertiseQuestion& question : questions) {
        Group with, without;
        for (const ParticipantQuality& one : participants) {
            const auto found = question.by_participant.find(one.participant);
            if (found != question.by_participant.end() && one.answers() > 0) {
                (found->second ? with : without).add(one);
            }
        }
        result.push_back({question.column, question.file, with.summary(), without.summary(),
                          rank_sum_test(with.proportions, without.proportions),
                          welch_test(with.proportions, without.proportions)});
    }
    return result;
}

std::string expertise_sentence(const ExpertiseComparison& c) {
    if (!c.rank_sum) {
        return fmt::format("\"{}\": {} with and {} without; nothing to compare.", c.column,
                           participants_text(c.with.participants), c.without.participants);
    }
    const auto group = [](const GroupErrors& g) {
        return fmt::format("{:.1f} errors in {:.1f} answers{}",
                           static_cast<double>(g.errors) / static_cast<double>(g.participants),
                           static_cast<double>(g.answers) / static_cast<double>(g.participants),
                           g.participants == 1 ? "" : " each");
    };
    return fmt::format("\"{}\": {} with it made {}, {} without it {}; {} (rank-sum p {}).", c.column,
                       participants_text(c.with.participants), group(c.with), c.without.participants,
                       group(c.without),
                       c.rank_sum->p <= alpha ? "a significant difference" : "no significant difference",
                       p_phrase(c.rank_sum->p));
}

} // namespace stats
