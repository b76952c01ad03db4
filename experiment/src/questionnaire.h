// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <utility>
#include <vector>

#include <study/session.h>

#include "stage.h"

namespace experiment {

/// A participant's answers as they are written, by the questions' ids, in the protocol's order.
using Answers = std::vector<std::pair<std::string, std::string>>;

/// The form that asks for consent.
Form consent_form(const study::SessionTexts& texts);

/// The form that asks one of the protocol's questions, from 0.
Form question_form(const study::SessionSettings& session, std::size_t number);

/// What is asked where something could not be saved: try again (0) or end the session (1).
Form trouble_form(const study::SessionTexts& texts, const std::string& message);

/// What is asked where the window should close: go on (0) or end the session (1).
Form close_form(const study::SessionTexts& texts);

/// What is shown while the screen, of these sizes, is too small for the pictures.
Form screen_form(const study::SessionTexts& texts, const std::string& sizes);

/// Ask for consent, where the protocol has a form; whether it was given. Throws Interrupted.
bool ask_consent(const study::SessionTexts& texts, Stage& stage);

/// Ask the protocol's questions one by one; the participant may go back. Throws Interrupted.
Answers ask_questions(const study::SessionSettings& session, Stage& stage);

/// An answer as it is written to a table: values of choices, several separated by semicolons; n/a for none;
/// ages above 89 as 89, which BIDS asks for.
std::string written(const study::Question& question, const FormAnswer& answer);

} // namespace experiment
