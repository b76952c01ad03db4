// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

#include <stats/analysis.h>

namespace stats {

/// Where the pooled test (answers as the sample) and the sign-flip test (participants as the sample) disagree
/// at the level alpha, in sentences; one that they agree on every shader where they do.
std::vector<std::string> disagreements(const Analysis& analysis);

/// Whether they disagree on a shader over all conditions.
bool any_shader_disagrees(const Analysis& analysis);

/// The answer on a pair of shaders.
struct Verdict {
    std::string
        headline; ///< whether they differ, are as good as each other within the bounds, or neither is shown
    std::string evidence; ///< how sure that is
};

/// For each pair of shaders over all conditions.
std::vector<Verdict> verdicts(const Analysis& analysis);

/// The verdict in a few words: "differs", "as good within 0.35 to 0.65", ...
std::string verdict_words(const Figures& figures, const EquivalenceBounds& bounds);

/// Which interval was favoured, over all answers.
std::string order_sentence(const Analysis& analysis);

} // namespace stats
