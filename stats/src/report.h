// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include <stats/study.h>
#include <stats/table.h>

namespace stats {

/// Text for HTML: the characters that mean markup are escaped, control characters are made visible.
std::string html_text(const std::string& text);

/// Bytes in base64 with padding [Josefsson2006, section 4].
std::string base64(std::string_view bytes);

/// The bytes of a PNG file, if there is one. Throws support::InputError for a file that is no whole PNG.
std::optional<std::string> read_png(const std::filesystem::path& file);

/// The report, one self-contained HTML page. `contact_sheet` holds a PNG's bytes.
std::string report_html(const Study& study, std::span<const Row> rows, const std::string& figure8_svg,
                        const std::optional<std::string>& contact_sheet);

} // namespace stats
