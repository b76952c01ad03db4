// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "texts.h"

#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include <support/error.h>
#include <support/text_raster.h>

#include "../procedure.h"
#include "../questionnaire.h"
#include "form_layout.h"
#include "page.h"

namespace experiment {
namespace {

/// Scripts that are written from right to left or whose letters change with their neighbours, by the blocks
/// of Unicode: Hebrew and Arabic to Myanmar, Khmer and Mongolian, presentation forms.
bool needs_shaping(char32_t code) {
    const auto within = [&](char32_t first, char32_t last) { return code >= first && code <= last; };
    return within(0x590, 0x109f) || within(0x1780, 0x18af) || within(0xfb1d, 0xfdff) ||
           within(0xfe70, 0xfeff);
}

void check_letters(const std::string& text, const std::string& field) {
    for (const char32_t code : support::code_points(text)) {
        if (needs_shaping(code)) {
            throw support::input_error("{}: expected a script that is written from left to right in single "
                                       "letters, found a letter U+{:04X} of another",
                                       field, static_cast<std::uint32_t>(code));
        }
    }
    if (const std::string letter = support::letter_without_font(text); !letter.empty()) {
        throw support::input_error(
            "{}: expected letters that the fonts have, found \"{}\" (for Chinese, Japanese and "
            "Korean install the Debian package fonts-droid-fallback)",
            field, letter);
    }
}

/// Refuse forms that do not fit: those before the trials, and those that come unasked.
void check_forms(const study::Protocol& protocol, const std::array<int, 2>& size) {
    const auto& session = protocol.session;
    const TemporaryFonts fonts(form_texts(protocol), size[1]);
    const auto check = [&](const Form& form, const std::string& field) {
        check_form(form, fonts.get(), size, fmt::format("{}: session.{}", protocol.file.string(), field));
    };
    if (!session.texts.consent.empty()) {
        check(consent_form(session.texts), "texts.consent");
    }
    for (std::size_t i = 0; i < session.questions.size(); ++i) {
        check(question_form(session, i), fmt::format("questions[{}]", i));
    }
    check(trouble_form(session.texts, ""), "texts.trouble");
    check(close_form(session.texts), "texts.close");
}

} // namespace

void check_texts(const study::Protocol& protocol, std::size_t trials, const std::array<int, 2>& size) {
    const study::SessionTexts& texts = protocol.session.texts;
    const auto field = [&](const std::string& name) {
        return fmt::format("{}: session.{}", protocol.file.string(), name);
    };
    // A key that came too early is told of below the next page.
    const std::string early = "\n\n" + texts.early;
    for (const auto& [name, text] :
         {std::pair{"instructions", texts.instructions}, std::pair{"practice", texts.practice + early},
          std::pair{"practice_end", texts.practice_end + early}, std::pair{"trial", texts.trial + early},
          std::pair{"pause", texts.pause}, std::pair{"declined", texts.declined}, std::pair{"end", texts.end},
          std::pair{"waiting", texts.waiting}}) {
        const std::string at = field(std::string("texts.") + name);
        check_letters(text, at);
        lay_out(fill_in(text, trials, trials), size[0], size[1], at);
    }
    for (const auto& [name, text] :
         {std::pair{"consent", texts.consent}, std::pair{"agree", texts.agree},
          std::pair{"decline", texts.decline}, std::pair{"next", texts.next}, std::pair{"back", texts.back},
          std::pair{"question", texts.question}, std::pair{"missing", texts.missing},
          std::pair{"wrong", texts.wrong}, std::pair{"more", texts.more}, std::pair{"trouble", texts.trouble},
          std::pair{"try_again", texts.try_again}, std::pair{"stop", texts.stop},
          std::pair{"close", texts.close}, std::pair{"go_on", texts.go_on},
          std::pair{"screen", texts.screen}}) {
        check_letters(text, field(std::string("texts.") + name));
    }
    for (std::size_t i = 0; i < protocol.session.questions.size(); ++i) {
        const study::Question& question = protocol.session.questions[i];
        check_letters(question.text, field(fmt::format("questions[{}].text", i)));
        check_letters(question.units, field(fmt::format("questions[{}].units", i)));
        for (const std::string& choice : question.choices) {
            check_letters(choice, field(fmt::format("questions[{}].choices", i)));
        }
    }
    check_forms(protocol, size);
}

std::vector<std::string> form_texts(const study::Protocol& protocol) {
    const study::SessionTexts& texts = protocol.session.texts;
    std::vector<std::string> all{protocol.title, texts.consent, texts.agree,    texts.decline,
                                 texts.next,     texts.back,    texts.question, texts.missing,
                                 texts.wrong,    texts.more,    texts.trouble,  texts.try_again,
                                 texts.stop,     texts.close,   texts.go_on,    texts.screen};
    for (const study::Question& question : protocol.session.questions) {
        all.push_back(question.text + question.units);
        all.insert(all.end(), question.choices.begin(), question.choices.end());
    }
    return all;
}

} // namespace experiment
