// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "questionnaire.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <utility>

#include "procedure.h"

namespace experiment {
namespace {

constexpr int oldest_written = 89; // BIDS: older participants could be found out

std::optional<int> whole_number(const std::string& text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

Form choice_form(const study::SessionTexts& texts, std::string id, std::string text,
                 std::vector<std::string> choices) {
    Form form;
    form.kind = Form::Kind::choice;
    form.id = std::move(id);
    form.text = std::move(text);
    form.choices = std::move(choices);
    form.next = texts.next;
    form.missing = texts.missing;
    form.more = texts.more;
    return form;
}

/// A cell of a table holds no tab and no line break.
std::string one_cell(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; },
        ' ');
    const std::size_t start = text.find_first_not_of(' ');
    return start == std::string::npos ? "" : text.substr(start, text.find_last_not_of(' ') - start + 1);
}

} // namespace

bool will_do(const Form& form, const FormAnswer& answer) {
    const bool empty = answer.chosen.empty() && one_cell(answer.text).empty();
    if (empty || form.kind == Form::Kind::notice) {
        return form.optional || form.kind == Form::Kind::notice;
    }
    if (form.kind != Form::Kind::integer) {
        return true;
    }
    const auto value = whole_number(answer.text);
    return value && *value >= form.least && *value <= form.most;
}

void choose(const Form& form, std::size_t place, FormAnswer& answer) {
    if (place >= form.choices.size()) {
        return;
    }
    auto& chosen = answer.chosen;
    const auto found = std::find(chosen.begin(), chosen.end(), place);
    if (form.kind == Form::Kind::choice) {
        chosen = {place};
    } else if (found != chosen.end()) {
        chosen.erase(found);
    } else {
        // What excludes the others takes their place, and they take its.
        if (form.alone == place) {
            chosen.clear();
        } else if (form.alone) {
            std::erase(chosen, *form.alone);
        }
        chosen.insert(std::upper_bound(chosen.begin(), chosen.end(), place), place);
    }
}

std::string written(const study::Question& question, const FormAnswer& answer) {
    std::string cell;
    for (const std::size_t place : answer.chosen) {
        cell += (cell.empty() ? "" : ";") + question.values[place];
    }
    if (question.kind == study::QuestionKind::text) {
        cell = one_cell(answer.text);
    }
    if (const auto value = whole_number(answer.text);
        question.kind == study::QuestionKind::integer && value) {
        cell = std::to_string(question.id == "age" ? std::min(*value, oldest_written) : *value);
    }
    return cell.empty() ? "n/a" : cell;
}

Form question_form(const study::SessionSettings& session, std::size_t number) {
    const study::Question& question = session.questions[number];
    Form form;
    switch (question.kind) {
    case study::QuestionKind::integer:
        form.kind = Form::Kind::integer;
        break;
    case study::QuestionKind::choice:
        form.kind = Form::Kind::choice;
        break;
    case study::QuestionKind::multiple:
        form.kind = Form::Kind::multiple;
        break;
    case study::QuestionKind::text:
        form.kind = Form::Kind::text;
        break;
    }
    form.id = question.id;
    form.heading = fill_in(session.texts.question, number + 1, session.questions.size());
    form.text = question.text;
    form.choices = question.choices;
    if (question.none_place() < question.values.size()) {
        form.alone = question.none_place();
    }
    form.more = session.texts.more;
    form.least = question.least;
    form.most = question.most;
    form.units = question.units;
    form.optional = question.optional;
    form.can_go_back = number > 0;
    form.next = session.texts.next;
    form.back = session.texts.back;
    form.missing = session.texts.missing;
    form.wrong = session.texts.wrong;
    return form;
}

Form consent_form(const study::SessionTexts& texts) {
    Form form = choice_form(texts, "consent", texts.consent, {texts.agree, texts.decline});
    form.after_reading = 0; // to agree; no one has to read on to decline
    return form;
}

Form trouble_form(const study::SessionTexts& texts, const std::string& message) {
    return choice_form(texts, "trouble", texts.trouble + "\n\n" + message, {texts.try_again, texts.stop});
}

Form close_form(const study::SessionTexts& texts) {
    return choice_form(texts, "close", texts.close, {texts.go_on, texts.stop});
}

Form screen_form(const study::SessionTexts& texts, const std::string& sizes) {
    Form form;
    form.id = "screen";
    form.text = texts.screen;
    form.facts = {{"px", sizes}};
    form.next = texts.next;
    return form;
}

bool ask_consent(const study::SessionTexts& texts, Stage& stage) {
    return texts.consent.empty() || stage.ask(consent_form(texts)).chosen.front() == 0;
}

Answers ask_questions(const study::SessionSettings& session, Stage& stage) {
    std::vector<FormAnswer> given(session.questions.size());
    for (std::size_t i = 0; i < given.size();) {
        Form form = question_form(session, i);
        form.given = given[i];
        given[i] = stage.ask(form);
        i = std::exchange(given[i].back, false) ? i - 1 : i + 1;
    }
    Answers answers;
    for (std::size_t i = 0; i < given.size(); ++i) {
        answers.emplace_back(session.questions[i].id, written(session.questions[i], given[i]));
    }
    return answers;
}

} // namespace experiment
