// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/log.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <unordered_set>

#include <fmt/format.h>

#include <support/error.h>
#include <support/file.h>

namespace stats {
namespace {

enum Column : std::size_t {
    trial,
    reference,
    test,
    distance,
    azimuth_deg,
    first,
    second,
    response,
    chosen,
    response_time,
    onset_first,
    onset_grey,
    onset_second,
    column_count
};

constexpr std::array<std::string_view, column_count> column_names{
    "trial",    "reference", "test",          "distance",    "azimuth_deg", "first",       "second",
    "response", "chosen",    "response_time", "onset_first", "onset_grey",  "onset_second"};

constexpr std::array<std::string_view, 5> known_shaders{"no_sss", "ts", "ss_jittered", "ss_full",
                                                        "reference"};

constexpr std::string_view missing = "n/a", byte_order_mark = "\xef\xbb\xbf";
constexpr std::size_t longest_name = 64;
// Far above the longest session; a larger file is no log.
constexpr std::uintmax_t largest_log = std::uintmax_t{16} << 20;

/// The text in quotes, cut where it would fill the screen.
std::string quoted(std::string_view text) {
    constexpr std::size_t shown = 60;
    return fmt::format("\"{}{}\"", text.substr(0, shown), text.size() > shown ? "..." : "");
}

void split(std::string_view line, std::vector<std::string_view>& fields) {
    fields.clear();
    for (std::size_t start = 0;;) {
        const auto tab = line.find('\t', start);
        fields.push_back(line.substr(start, tab - start));
        if (tab == std::string_view::npos) {
            return;
        }
        start = tab + 1;
    }
}

/// The number that the whole text spells, if it does.
template <typename T>
std::optional<T> number_in(std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// One line's fields, with errors that name file, line and column.
struct Line {
    const std::string& file;
    std::size_t number = 0;
    std::vector<std::string_view> fields;

    support::InputError error(std::string_view message) const {
        return support::input_error("{}:{}: {}", file, number, message);
    }

    support::InputError error(Column column, std::string_view expected) const {
        return error(
            fmt::format("{}: expected {}, found {}", column_names[column], expected, quoted(fields[column])));
    }

    /// A shader's or distance's name: the characters that stand in file names.
    std::string name(Column column) const {
        const auto plain = [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
                   c == '-' || c == '+' || c == '.';
        };
        const std::string_view text = fields[column];
        if (text.empty() || text.size() > longest_name || !std::all_of(text.begin(), text.end(), plain)) {
            throw error(column, "a name of 1 to 64 letters, digits, _, -, + and .");
        }
        return std::string(text);
    }

    double number_between(Column column, double least, double most, std::string_view expected) const {
        const auto value = number_in<double>(fields[column]);
        if (!value || !(*value >= least && *value <= most)) {
            throw error(column, expected);
        }
        return *value + 0.0; // -0 becomes 0
    }

    /// One of the shaders that a protocol may name.
    std::string shader(Column column) const {
        const std::string found = name(column);
        if (std::find(known_shaders.begin(), known_shaders.end(), found) == known_shaders.end()) {
            throw error(column, fmt::format("a shader ({})", fmt::join(known_shaders, ", ")));
        }
        return found;
    }

    std::optional<double> seconds(Column column) const {
        constexpr double longest_s = 1e9;
        return fields[column] == missing
                   ? std::nullopt
                   : std::optional(number_between(column, 0, longest_s, "seconds from 0 on, or n/a"));
    }
};

void check_header(const Line& line) {
    const auto& found = line.fields;
    if (found.front().starts_with(byte_order_mark)) {
        throw line.error("expected plain UTF-8 without a byte order mark");
    }
    // What spreadsheets make of a log: other separators, texts in quotes.
    if (found.size() == 1) {
        for (const auto& [separator, name] : {std::pair(',', "commas"), std::pair(';', "semicolons")}) {
            if (found.front().find(separator) != std::string_view::npos) {
                throw line.error(fmt::format("expected columns separated by tabs, found {}", name));
            }
        }
    }
    if (found.front().starts_with('"')) {
        throw line.error("expected plain texts, found quotes");
    }
    for (std::size_t i = 0; i < column_count; ++i) {
        if (i >= found.size() || found[i] != column_names[i]) {
            throw line.error(fmt::format("expected \"{}\" as column {} of the header, found {}",
                                         column_names[i], i + 1,
                                         i < found.size() ? quoted(found[i]) : "the end of the line"));
        }
    }
}

/// Whether the reference was chosen, after checking the answer against what was shown.
std::optional<bool> answer(const Line& line, const Condition& condition) {
    const auto& f = line.fields;
    const bool reference_first = f[first] == condition.reference && f[second] == condition.test;
    if (!reference_first && !(f[first] == condition.test && f[second] == condition.reference)) {
        throw line.error(fmt::format("first, second: expected {} and {} in either order, found {} and {}",
                                     condition.reference, condition.test, quoted(f[first]),
                                     quoted(f[second])));
    }
    if (f[response] != "1" && f[response] != "2" && f[response] != missing) {
        throw line.error(response, "1, 2 or n/a");
    }
    const std::string_view implied = f[response] == "1" ? f[first] : f[response] == "2" ? f[second] : missing;
    if (f[chosen] != implied) {
        throw line.error(chosen, fmt::format("{}, as the response is {}", implied, f[response]));
    }
    return implied == missing ? std::nullopt : std::optional(implied == condition.reference);
}

Trial parse_trial(const Line& line) {
    Trial result;
    const auto number = number_in<std::int64_t>(line.fields[trial]);
    if (!number || *number < 1) {
        throw line.error(trial, "a whole number from 1 on");
    }
    result.number = *number;
    result.condition = {line.shader(reference), line.shader(test), line.name(distance),
                        line.number_between(azimuth_deg, -360, 360, "degrees from -360 to 360")};
    if (result.condition.reference == result.condition.test) {
        throw line.error(test, "another shader than the reference");
    }
    result.reference_chosen = answer(line, result.condition);
    result.reference_first = line.fields[first] == result.condition.reference;
    result.response_time_s = line.seconds(response_time);
    result.onset_first_s = line.seconds(onset_first);
    result.onset_grey_s = line.seconds(onset_grey);
    result.onset_second_s = line.seconds(onset_second);
    return result;
}

} // namespace

Log parse_log(std::string_view text, const std::string& name) {
    Log log;
    Line line{name, 1, {}};
    if (text.empty()) {
        throw line.error("expected a header line, found an empty file");
    }
    std::size_t header_fields = 0;
    std::unordered_set<std::int64_t> seen;
    for (std::size_t start = 0; start < text.size(); ++line.number) {
        const auto end = text.find('\n', start);
        const bool whole = end != std::string_view::npos;
        const std::string_view content = text.substr(start, whole ? end - start : end);
        start = whole ? end + 1 : text.size();
        split(content, line.fields);

        // Set a torn last line aside; its last field may have lost digits even where all fields are there.
        const bool is_header = line.number == 1, is_last = start == text.size();
        const auto fields = line.fields.size();
        if (!is_header && is_last && (!whole || fields < header_fields)) {
            log.torn = {line.number, whole ? fmt::format("{} of {} fields", fields, header_fields)
                                           : std::string("no line break at its end")};
            break;
        }
        if (content.ends_with('\r')) {
            throw line.error("expected lines that end with a line feed alone, found a carriage return");
        }
        if (is_header) {
            check_header(line);
            if (!whole) {
                throw line.error("expected a line break after the header, found the end of the file");
            }
            header_fields = fields;
            continue;
        }
        if (fields != header_fields) {
            throw line.error(
                fmt::format("expected {} fields separated by tabs, found {}", header_fields, fields));
        }
        log.trials.push_back(parse_trial(line));
        if (!seen.insert(log.trials.back().number).second) {
            throw line.error(trial, "each trial once");
        }
    }
    return log;
}

Log read_log(const std::filesystem::path& file) {
    return parse_log(support::read_text(file, largest_log), file.string());
}

} // namespace stats
