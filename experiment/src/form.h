// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace experiment {

/// What came back.
struct FormAnswer {
    bool back = false;                    ///< to the form before
    std::vector<std::size_t> chosen = {}; ///< places of choices, rising
    std::string text = {};                ///< of a whole number or a text
};

/// A page that asks for something; texts are UTF-8.
struct Form {
    /// A notice asks for nothing, a choice for one of several, multiple for any number of them.
    enum class Kind { notice, choice, multiple, integer, text };
    Kind kind = Kind::notice;
    std::string id;                                         ///< what is asked for
    std::string heading, text;                              ///< small above, large below
    std::vector<std::pair<std::string, std::string>> facts; ///< a table below the text
    std::vector<std::string> warnings;                      ///< set apart below the table
    std::vector<std::string> choices;
    int least = 0, most = 0; ///< of a whole number
    std::string units;
    std::optional<std::size_t> alone; ///< a place of multiple choices that excludes the others
    bool optional = false, can_go_back = false;
    std::optional<std::size_t> after_reading; ///< a choice for which the text's end must have been seen
    FormAnswer given;                         ///< that it shows at first
    std::string next, back;                   ///< what the keys do
    std::string missing, wrong;               ///< what is said to no answer, and to a number out of its range
    std::string more;                         ///< what is said where the text goes on below
};

/// Whether an answer will do.
bool will_do(const Form& form, const FormAnswer& answer);

/// Choose a place, or take a choice of several back; places that there are not stay unchosen.
void choose(const Form& form, std::size_t place, FormAnswer& answer);

} // namespace experiment
