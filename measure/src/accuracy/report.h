// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <string>

#include "front.h"
#include "sweep.h"

namespace measure {

/// accuracy.tsv and closed_forms.tsv; numbers read back exactly.
std::string accuracy_tsv(std::span<const AccuracyRow> rows);
std::string closed_forms_tsv(std::span<const ClosedFormRow> rows);

/// Time against FLIP, a panel a distance, settings on the front named. Throws support::Failure without
/// gnuplot.
std::string accuracy_svg(const AccuracyResult& result, std::span<const Summary> summaries);

/// One self-contained page: findings, figure, front, all settings, closed forms, machine.
std::string accuracy_html(const AccuracyResult& result, std::span<const Summary> summaries,
                          const std::string& svg);

/// The front and the findings for a terminal.
std::string accuracy_text(const AccuracyResult& result, std::span<const Summary> summaries);

} // namespace measure
