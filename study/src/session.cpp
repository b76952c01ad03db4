// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "session.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "checks.h"

namespace study {
namespace {

using support::TomlTable;

constexpr int most_trials_between = 100000;
constexpr std::size_t most_questions = 100;

void check_one_of(const TomlTable& table, std::string_view key, const std::string& shader,
                  const std::vector<std::string>& shaders) {
    check_shader(table, key, shader);
    if (std::find(shaders.begin(), shaders.end(), shader) == shaders.end()) {
        throw table.error(key, fmt::format("expected one of the protocol's shaders ({}), found \"{}\"",
                                           fmt::join(shaders, ", "), shader));
    }
}

void read_comparison(TomlTable& table, const std::vector<std::string>& shaders, SessionSettings& session) {
    const bool has_ts = std::find(shaders.begin(), shaders.end(), "ts") != shaders.end();
    session.reference = table.text("reference", has_ts ? "ts" : shaders.front());
    std::vector<std::string> others;
    std::copy_if(shaders.begin(), shaders.end(), std::back_inserter(others),
                 [&](const std::string& shader) { return shader != session.reference; });
    session.tests = others.empty() && !table.has("tests") ? others : table.texts("tests", others);
    check_unique(table, "tests", session.tests);
    check_one_of(table, "reference", session.reference, shaders);
    for (const std::string& test : session.tests) {
        check_one_of(table, "tests", test, shaders);
        if (test == session.reference) {
            throw table.error("tests",
                              fmt::format("expected shaders other than the reference, found \"{}\"", test));
        }
    }
}

KeyChord read_chord(TomlTable& table) {
    const std::string text = table.text("leave", "ctrl+shift+q");
    const auto wrong = [&] {
        return table.error("leave",
                           fmt::format("expected ctrl or alt, with or without shift, and a letter or "
                                       "digit, as in \"ctrl+shift+q\", found \"{}\"",
                                       support::one_line(text)));
    };
    KeyChord chord;
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part, '+');) {
        const bool key =
            part.size() == 1 && ((part[0] >= 'a' && part[0] <= 'z') || (part[0] >= '0' && part[0] <= '9'));
        if (part == "ctrl") {
            chord.ctrl = true;
        } else if (part == "shift") {
            chord.shift = true;
        } else if (part == "alt") {
            chord.alt = true;
        } else if (key && chord.key == 0) {
            chord.key = part[0];
        } else {
            throw wrong();
        }
    }
    // A key alone would be pressed by accident.
    if (chord.key == 0 || !(chord.ctrl || chord.alt)) {
        throw wrong();
    }
    return chord;
}

/// A cell of a table holds no tab and no line break.
void check_cell(const TomlTable& table, std::string_view key, const std::string& text) {
    const auto control = [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; };
    if (text.empty() || std::any_of(text.begin(), text.end(), control)) {
        throw table.error(key,
                          fmt::format("expected a text of one line, found \"{}\"", support::one_line(text)));
    }
}

void read_choices(TomlTable& table, Question& question) {
    question.choices = table.texts("choices");
    if (question.choices.size() < 2 || question.choices.size() > most_choices) {
        throw table.error("choices", fmt::format("expected 2 to {} texts, found {}", most_choices,
                                                 question.choices.size()));
    }
    question.values = table.texts("values", question.choices);
    if (question.values.size() != question.choices.size()) {
        throw table.error("values", fmt::format("expected one a choice, {}, found {}",
                                                question.choices.size(), question.values.size()));
    }
    const char* key = table.has("values") ? "values" : "choices";
    for (const std::string& value : question.values) {
        check_cell(table, key, value);
        // Several values of one answer are separated by semicolons, and what is missing stands alone.
        if (question.kind == QuestionKind::multiple &&
            (value.find(';') != std::string::npos || value == "n/a")) {
            throw table.error(key, fmt::format("expected no semicolon and not \"n/a\", found \"{}\"", value));
        }
    }
    check_unique(table, key, question.values);
}

Question read_question(TomlTable& table) {
    Question question;
    question.id = table.text("id");
    const auto plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    if (question.id.empty() || question.id.size() > 64 || question.id == "participant_id" ||
        !std::all_of(question.id.begin(), question.id.end(), plain)) {
        throw table.error("id", fmt::format("expected 1 to 64 letters, digits and underscores, not "
                                            "\"participant_id\", found \"{}\"",
                                            support::one_line(question.id)));
    }
    question.text = table.text("text");
    question.optional = table.boolean("optional", false);
    const std::string kind = table.word("kind", {"integer", "choice", "multiple", "text"});
    if (kind == "integer") {
        question.kind = QuestionKind::integer;
        question.least = table.integer("least", -1000000, 1000000, 0);
        question.most = table.integer("most", question.least, 1000000, 1000000);
        question.units = table.text("units", "");
    } else if (kind != "text") {
        question.kind = kind == "choice" ? QuestionKind::choice : QuestionKind::multiple;
        read_choices(table, question);
    }
    return question;
}

std::vector<Question> read_questions(TomlTable& table) {
    std::vector<Question> questions;
    std::vector<std::string> ids;
    for (TomlTable& entry : table.tables("questions")) {
        questions.push_back(read_question(entry));
        ids.push_back(questions.back().id);
    }
    if (questions.size() > most_questions) {
        throw table.error("questions",
                          fmt::format("expected at most {}, found {}", most_questions, questions.size()));
    }
    check_unique(table, "questions", ids);
    return questions;
}

/// What stands in braces is filled in, so that a misspelt name would be shown as it is.
void check_placeholders(const TomlTable& table, std::string_view key, const std::string& text) {
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ_abcdefghijklmnopqrstuvwxyz";
    for (std::size_t open = text.find('{'); open != std::string::npos; open = text.find('{', open + 1)) {
        const std::size_t end = text.find_first_not_of(letters, open + 1);
        if (end == open + 1 || end == std::string::npos || text[end] != '}') {
            continue; // no name in braces
        }
        const std::string name = text.substr(open + 1, end - open - 1);
        if (name != "trial" && name != "trials") {
            throw table.error(
                key, fmt::format("expected {{trial}} or {{trials}} in braces, found \"{{{}}}\"", name));
        }
    }
}

SessionTexts read_texts(TomlTable table) {
    SessionTexts texts;
    const auto text = [&](std::string_view key, const std::string& fallback) {
        const std::string found = table.text(key, fallback);
        check_placeholders(table, key, found);
        return found;
    };
    texts.consent = text("consent", "");
    texts.agree = text("agree", "I agree and want to take part");
    texts.decline = text("decline", "I do not want to take part");
    texts.declined = text("declined", "Thank you for your time. Nothing was saved.\n\n"
                                      "Please tell the experimenter.\n\nPress space to finish.");
    texts.instructions = text("instructions", "You will see {trials} pairs of images, one image after "
                                              "the other.\nChoose the one that looks most realistic."
                                              "\n\nPress space to begin.");
    texts.practice = text("practice", "Practice {trial} of {trials}\n\nPress space for the first image.");
    texts.practice_end = text("practice_end", "That was the practice.\n\nPress space to go on.");
    texts.trial = text("trial", "Trial {trial} of {trials}\n\nPress space for the first image.");
    texts.early = text("early", "You pressed a key before the second image was shown. It did not count.\n"
                                "Please press 1 or 2 while you see the second image.");
    texts.pause = text("pause", "{trial} of {trials} are done. Take a break if you like.\n\n"
                                "Press space to go on.");
    texts.end = text("end", "That was the last trial. Thank you.\n\nPress space to finish.");
    texts.next = text("next", "Enter: next");
    texts.back = text("back", "Page Up: back");
    texts.question = text("question", "Question {trial} of {trials}");
    texts.missing = text("missing", "Please answer this question.");
    texts.wrong = text("wrong", "Please type a whole number in the range beside the field.");
    texts.more = text("more", "There is more to read: the arrow keys move the text.");
    texts.trouble = text("trouble", "Please call the experimenter.\n\n"
                                    "The last answer is kept in memory until it is saved.");
    texts.try_again = text("try_again", "Try again");
    texts.stop = text("stop", "End the session");
    texts.close = text("close", "Someone asked to close this window.\n\nEnd the session? What was "
                                "answered so far is saved, and the session can be gone on with.");
    texts.go_on = text("go_on", "Go on with the session");
    texts.screen = text("screen", "The screen has become too small for the images.\n\nPlease call the "
                                  "experimenter. The session goes on when the screen is as it was.");
    texts.waiting = text("waiting", "One moment, please.\n\nAnother program is writing to the study.");
    return texts;
}

} // namespace

std::size_t Question::none_place() const {
    const auto none = std::find(values.begin(), values.end(), "none");
    return kind == QuestionKind::multiple ? static_cast<std::size_t>(none - values.begin()) : values.size();
}

std::string text_of(const KeyChord& chord) {
    return fmt::format("{}{}{}{}", chord.ctrl ? "Ctrl+" : "", chord.alt ? "Alt+" : "",
                       chord.shift ? "Shift+" : "",
                       static_cast<char>(std::toupper(static_cast<unsigned char>(chord.key))));
}

SessionSettings read_session(TomlTable table, const std::vector<std::string>& shaders) {
    SessionSettings session;
    read_comparison(table, shaders, session);
    session.both_orders = table.boolean("both_orders", session.both_orders);
    session.immediate_repeats = table.boolean("immediate_repeats", session.immediate_repeats);
    session.practice = table.integer("practice", 0, 1000, session.practice);
    session.pause_every = table.integer("pause_every", 0, most_trials_between, session.pause_every);
    session.grey_s = table.number("grey_s", 0, 600, session.grey_s);
    session.grey_level = table.number("grey_level", 0, 1, session.grey_level);
    session.leave = read_chord(table);
    if (table.has("questions")) {
        session.questions = read_questions(table);
    }
    session.texts = read_texts(table.table("texts"));
    return session;
}

} // namespace study
