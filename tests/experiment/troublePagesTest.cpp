// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <map>
#include <set>

#include <gtest/gtest.h>

#include <study/protocol.h>
#include <support/error.h>

#include "fixture.h"
#include "questionnaire.h"
#include "window/texts.h"

namespace {

using experiment::Form;

// Every text of a page that comes unasked, in another language.
const std::map<std::string, std::string> translated{{"trouble", "Bitte rufen Sie die Versuchsleitung."},
                                                    {"try_again", "Noch einmal versuchen"},
                                                    {"stop", "Sitzung beenden"},
                                                    {"close", "Soll die Sitzung enden?"},
                                                    {"go_on", "Sitzung fortsetzen"},
                                                    {"screen", "Der Bildschirm ist zu klein für die Bilder."},
                                                    {"next", "Eingabetaste: weiter"},
                                                    {"missing", "Bitte wählen Sie eine Antwort."},
                                                    {"more", "Der Text geht weiter: Pfeiltasten."},
                                                    {"waiting", "Einen Augenblick bitte."}};

class TroublePagesTest : public testing::Test {
protected:
    study::Protocol protocol_with(const std::map<std::string, std::string>& texts) const {
        std::string toml = "name = \"trouble\"\nshaders = [\"no_sss\", \"ts\"]\n"
                           "[camera]\ndistances = [{ name = \"near\", units = 50 }]\n"
                           "[light]\nazimuths_deg = [0]\n[session.texts]\n";
        for (const auto& [key, text] : texts) {
            toml += key + " = \"" + text + "\"\n";
        }
        fixture::write(folder_ / "p.toml", toml);
        return study::read_protocol(folder_ / "p.toml");
    }
    /// What a session says of the protocol before it begins, on the published study's screen.
    std::string refusal(const std::map<std::string, std::string>& texts) const {
        try {
            experiment::check_texts(protocol_with(texts), 72, {1650, 988});
        } catch (const support::InputError& error) {
            return error.what();
        }
        return {};
    }
    static std::map<std::string, std::string> with(const std::string& key, const std::string& text) {
        auto texts = translated;
        texts[key] = text;
        return texts;
    }

    fixture::TemporaryFolder folder_;
};

/// All words of a form, in an order of its own.
std::multiset<std::string> words_of(const Form& form) {
    std::multiset<std::string> words(form.choices.begin(), form.choices.end());
    for (const std::string& text :
         {form.heading, form.text, form.next, form.back, form.missing, form.wrong, form.more}) {
        if (!text.empty()) {
            words.insert(text);
        }
    }
    return words;
}

TEST_F(TroublePagesTest, showTheProtocolsWordsAndNoOthers) {
    const study::SessionTexts texts = protocol_with(translated).session.texts;
    const auto words = [](std::initializer_list<const char*> keys) {
        std::multiset<std::string> all;
        for (const char* key : keys) {
            all.insert(translated.at(key));
        }
        return all;
    };
    EXPECT_EQ(words_of(experiment::close_form(texts)),
              words({"close", "go_on", "stop", "next", "missing", "more"}));
    EXPECT_EQ(words_of(experiment::screen_form(texts, "300 x 200")), words({"screen", "next"}));
    // What failed stands below, as the experimenter finds it in the sidecar, too.
    Form trouble = experiment::trouble_form(texts, "x.tsv: cannot be written");
    EXPECT_EQ(trouble.text, translated.at("trouble") + "\n\nx.tsv: cannot be written");
    trouble.text = translated.at("trouble");
    EXPECT_EQ(words_of(trouble), words({"trouble", "try_again", "stop", "next", "missing", "more"}));
    EXPECT_EQ(texts.waiting, translated.at("waiting"));
}

TEST_F(TroublePagesTest, areLaidOutBeforeTheSession) {
    EXPECT_EQ(refusal(translated), "");
    // Words that must keep to a line, and a page that has no arrow keys to scroll it.
    const std::string wide(150, 'w');
    for (const char* key : {"try_again", "stop", "go_on", "next"}) {
        EXPECT_NE(refusal(with(key, wide)).find("expected words that fit on one line"), std::string::npos)
            << key << ": " << refusal(with(key, wide));
    }
    std::string high;
    for (int i = 0; i < 100; ++i) {
        high += "w\\n";
    }
    EXPECT_NE(refusal(with("waiting", high)).find("session.texts.waiting: expected a text that fits"),
              std::string::npos);
}

TEST_F(TroublePagesTest, haveLettersBeforeTheSession) {
    for (const auto& [key, text] : translated) {
        // Hebrew is written from right to left, Devanagari joins its letters.
        for (const char* letters : {"\u05d0", "\u0915\u093f"}) {
            const std::string reason = refusal(with(key, letters));
            EXPECT_NE(reason.find("session.texts." + key + ": expected a script"), std::string::npos)
                << reason;
        }
        // No font has a letter there.
        const std::string reason = refusal(with(key, "\U000f1234"));
        EXPECT_NE(reason.find("session.texts." + key + ": expected letters"), std::string::npos) << reason;
    }
}

} // namespace
