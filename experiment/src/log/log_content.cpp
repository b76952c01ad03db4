// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "log_content.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include <support/error.h>
#include <support/file.h>

#include "session_log.h"

namespace experiment {
namespace {

enum Column : std::size_t {
    number,
    reference,
    test,
    distance,
    azimuth_deg,
    first,
    second,
    response,
    chosen,
    response_time,
    onset_second = 12,
    column_count
};

constexpr std::string_view missing = "n/a";

std::vector<std::string> cells_of(std::string_view line) {
    std::vector<std::string> cells;
    for (std::size_t start = 0;;) {
        const std::size_t tab = line.find('\t', start);
        cells.emplace_back(line.substr(start, tab - start));
        if (tab == std::string_view::npos) {
            return cells;
        }
        start = tab + 1;
    }
}

template <typename T>
std::optional<T> number_in(const std::string& text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// One line with its place, for errors.
struct Line {
    const std::string& file;
    std::size_t line;
    std::vector<std::string> cells;

    support::InputError error(std::string_view column, std::string_view expected,
                              const std::string& found) const {
        return support::input_error("{}:{}: {}: expected {}, found \"{}\"", file, line, column, expected,
                                    support::one_line(found).substr(0, 60));
    }
    double seconds(Column column, std::string_view name) const {
        if (cells[column] == missing) {
            return 0;
        }
        const auto value = number_in<double>(cells[column]);
        if (!value) {
            throw error(name, "seconds", cells[column]);
        }
        return *value;
    }
};

void add_trial(const Line& line, LogContent& content) {
    const auto& cells = line.cells;
    if (cells.size() < column_count) {
        throw support::input_error("{}:{}: expected at least {} columns, found {}", line.file, line.line,
                                   std::size_t{column_count}, cells.size());
    }
    const std::size_t expected = content.trials.size() + 1;
    if (number_in<std::size_t>(cells[number]) != expected) {
        throw line.error("trial", fmt::format("{}", expected), cells[number]);
    }
    const auto azimuth = number_in<int>(cells[azimuth_deg]);
    if (!azimuth) {
        throw line.error("azimuth_deg", "whole degrees", cells[azimuth_deg]);
    }
    const Trial trial{cells[reference], cells[test], cells[distance], *azimuth, cells[first], cells[second]};

    // A response taken out by hand stays out.
    if (cells[response] != missing) {
        if (cells[response] != "1" && cells[response] != "2") {
            throw line.error("response", "1, 2 or n/a", cells[response]);
        }
        const std::string& shader = cells[response] == "1" ? trial.first : trial.second;
        if (cells[chosen] != shader) {
            throw line.error("chosen", fmt::format("\"{}\"", shader), cells[chosen]);
        }
    }
    content.last_s = std::max(content.last_s, line.seconds(onset_second, "onset_second") +
                                                  line.seconds(response_time, "response_time"));
    content.trials.push_back(trial);
}

/// Take a last line without end for an answer where nothing of it is missing, as after an editor that drops
/// the last line's end; whether that was so.
bool take_unended(const Line& line, LogContent& content) {
    // A number that was being written has fewer decimals than a whole one.
    constexpr std::size_t decimals = 6;
    if (line.cells.size() != column_count) {
        return false;
    }
    const std::string& last = line.cells.back();
    const std::size_t point = last.find('.');
    if (last != missing && (point == std::string::npos || last.size() - point - 1 != decimals)) {
        return false;
    }
    try {
        add_trial(line, content);
        return true;
    } catch (const support::InputError&) {
        return false;
    }
}

void check_header(std::string_view row, const std::string& file) {
    if (!row.starts_with(log_header)) {
        throw support::input_error("{}:1: expected the columns of a session's log, found \"{}\"", file,
                                   support::one_line(std::string(row)).substr(0, 60));
    }
}

} // namespace

LogContent read_log(const fs::path& file) {
    const std::string text = support::read_text(file);
    const std::string name = file.string();
    LogContent content;
    std::string_view rest = text;
    for (std::size_t line = 1;; ++line) {
        const std::size_t end = rest.find('\n');
        std::string_view row = rest.substr(0, end);
        if (line == 1) {
            // The program makes a log with its header in one step: one without whole header was edited.
            check_header(row, name);
            if (end == std::string_view::npos) {
                throw support::input_error("{}:1: expected the end of the line, found the file's", name);
            }
        }
        if (end == std::string_view::npos) {
            content.torn = take_unended({name, line, cells_of(row)}, content) ? "" : row;
            break;
        }
        rest.remove_prefix(end + 1);
        if (row.ends_with('\r')) {
            row.remove_suffix(1);
        }
        if (line > 1) {
            add_trial({name, line, cells_of(row)}, content);
        }
    }
    content.whole = static_cast<off_t>(text.size() - content.torn.size());
    return content;
}

void check_order(const LogContent& content, const Schedule& schedule, const fs::path& file) {
    for (std::size_t i = 0; i < content.trials.size(); ++i) {
        const std::size_t line = i + 2; // the header is the first
        if (i >= schedule.size()) {
            throw support::input_error("{}:{}: expected no more than the {} planned trials, found another",
                                       file.string(), line, schedule.size());
        }
        if (content.trials[i] != schedule[i]) {
            throw support::input_error("{}:{}: expected the planned trial {}, found {}", file.string(), line,
                                       text_of(schedule[i]), text_of(content.trials[i]));
        }
    }
}

} // namespace experiment
