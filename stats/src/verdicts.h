// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

#include <stats/analysis.h>

namespace stats {

/// Where the pooled tests (answers as the sample) and those with the participants as the sample disagree at
/// the level alpha, in sentences; one that they agree where they do
/// and both can be tested, or that this cannot be told.
std::vector<std::string> disagreements(const Analysis& analysis);

/// Whether they disagree on a shader over all conditions.
bool any_shader_disagrees(const Analysis& analysis);

/// The answer on a pair of shaders.
struct Verdict {
    std::string headline; ///< which is preferred, or whether they are as good, and where that does not hold
    std::string evidence; ///< how sure that is
};

/// For each pair of shaders over all conditions.
std::vector<Verdict> verdicts(const Analysis& analysis);

/// A row's verdict in a few words: "differs, TS preferred", "as good within 0.35 to 0.65", "undecided", ...
std::string verdict_words(const GroupRow& group, const EquivalenceBounds& bounds);

/// Whether an interval was favoured, with the participants as the sample.
std::string order_sentence(const Analysis& analysis);

} // namespace stats
