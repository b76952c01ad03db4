// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <study/protocol.h>

#include "fixture.h"
#include "questionnaire.h"
#include "window/form_layout.h"
#include "window/texts.h"

namespace {

using experiment::check_texts;
using fixture::TemporaryFolder;

constexpr std::array<int, 2> screen{1650, 988};

/// A protocol with one question more.
study::Protocol protocol_with(const TemporaryFolder& folder, const std::string& question) {
    fixture::write(folder / "p.toml", "name = \"forms\"\nshaders = [\"no_sss\", \"ts\"]\n"
                                      "[camera]\ndistances = [{ name = \"near\", units = 50 }]\n"
                                      "[light]\nazimuths_deg = [0]\n" +
                                          question);
    return study::read_protocol(folder / "p.toml");
}

std::string choices(std::size_t count, const std::string& words) {
    std::string list;
    for (std::size_t i = 0; i < count; ++i) {
        list += (list.empty() ? "\"" : ", \"") + words + std::to_string(i) + "\"";
    }
    return "[[session.questions]]\nid = \"q\"\nkind = \"choice\"\ntext = \"What do you practise?\"\n"
           "choices = [" +
           list + "]\n";
}

std::string refusal(const study::Protocol& protocol, const std::array<int, 2>& size) {
    try {
        check_texts(protocol, 8, size);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return {};
}

TEST(FormLayoutTest, leavesNineChoicesAndTheirQuestionRoom) {
    const TemporaryFolder folder;
    const auto protocol = protocol_with(folder, choices(9, "choice "));
    const experiment::TemporaryFonts fonts(experiment::form_texts(protocol), screen[1]);
    const ImFont& font = *fonts.get().large;
    constexpr float height = 700;
    const auto form = experiment::question_form(protocol.session, 0);
    const auto layout = experiment::lay_out_form(form, font, 1188, height);
    EXPECT_TRUE(layout.whole);
    EXPECT_GE(layout.text, font.FontSize);
    EXPECT_GE(layout.row, font.FontSize); // letters are not cut
    EXPECT_LE(layout.text + 9 * layout.row + 9 * layout.gap, height);
    EXPECT_EQ(refusal(protocol, screen), "");
}

TEST(FormLayoutTest, keepsItsDistancesWhereThereIsRoom) {
    const TemporaryFolder folder;
    const auto two = protocol_with(folder, choices(2, "choice "));
    const auto three = protocol_with(folder, choices(3, "choice "));
    const experiment::TemporaryFonts fonts(experiment::form_texts(three), screen[1]);
    const ImFont& font = *fonts.get().large;
    EXPECT_EQ(experiment::lay_out_form(experiment::question_form(two.session, 0), font, 1188, 700).row,
              experiment::lay_out_form(experiment::question_form(three.session, 0), font, 1188, 700).row);
}

TEST(FormLayoutTest, leavesChoicesBelowALongTextTheirDistances) {
    const TemporaryFolder folder;
    const auto two = protocol_with(folder, choices(2, "choice "));
    auto form = experiment::question_form(two.session, 0);
    const experiment::TemporaryFonts fonts(experiment::form_texts(two), screen[1]);
    const auto plain = experiment::lay_out_form(form, *fonts.get().large, 1188, 700);
    for (int i = 0; i < 100; ++i) {
        form.text += "\nWhat have you practised for more than a year?";
    }
    const auto scrolling = experiment::lay_out_form(form, *fonts.get().large, 1188, 700);
    EXPECT_FALSE(scrolling.whole);
    EXPECT_EQ(scrolling.row, plain.row);
    // Letters that scroll stay more than a line's height off what follows.
    EXPECT_LT(scrolling.text + 2 * (scrolling.row + scrolling.gap), 700 - 1.2F * fonts.get().large->FontSize);
}

TEST(FormLayoutTest, refusesWordsThatDoNotFitOnTheirLine) {
    const TemporaryFolder folder;
    const auto protocol = protocol_with(folder, choices(2, std::string(120, 'w')));
    const std::string reason = refusal(protocol, screen);
    EXPECT_NE(reason.find("p.toml: session.questions[0]: expected words that fit on one line on a screen of "
                          "1650x988 pixels, found \"1   www"),
              std::string::npos)
        << reason;
    // The consent's answers are such words, too.
    const auto consent = protocol_with(folder, "[session.texts]\nconsent = \"Please.\"\nagree = \"" +
                                                   std::string(120, 'w') + "\"\n");
    EXPECT_NE(refusal(consent, screen).find("session.texts.consent"), std::string::npos);
}

TEST(FormLayoutTest, refusesAQuestionThatItsChoicesLeaveNoRoom) {
    const TemporaryFolder folder;
    const auto protocol = protocol_with(folder, choices(9, ""));
    EXPECT_EQ(refusal(protocol, {640, 480}), "");
    const std::string reason = refusal(protocol, {640, 200});
    EXPECT_NE(reason.find("session.questions[0]: expected a text and choices that have room"),
              std::string::npos)
        << reason;
}

TEST(FormLayoutTest, takesAConsentOfAnyLength) {
    const TemporaryFolder folder;
    std::string paragraphs;
    for (int i = 0; i < 200; ++i) {
        paragraphs += "We study how skin looks.\\n\\n";
    }
    EXPECT_EQ(refusal(protocol_with(folder, "[session.texts]\nconsent = \"" + paragraphs + "\"\n"), screen),
              "");
}

TEST(FormLayoutTest, acceptsThePublishedProtocols) {
    for (const auto& entry : std::filesystem::directory_iterator(SKIN2AFC_PROTOCOLS)) {
        if (entry.path().extension() == ".toml") {
            EXPECT_EQ(refusal(study::read_protocol(entry.path()), screen), "") << entry.path();
        }
    }
}

} // namespace
