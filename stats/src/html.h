// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stats {

/// Text for HTML: the characters that mean markup are escaped, control characters are made visible.
std::string html_text(const std::string& text);

/// Bytes in base64 with padding [Josefsson2006, section 4].
std::string base64(std::string_view bytes);

/// A paragraph and a list of texts, in a style of the sheet.
std::string paragraph(const std::string& text, std::string_view style = "");
std::string list_of(const std::vector<std::string>& items, std::string_view style = "");

/// A table that scrolls where it is too wide; cells are HTML.
class HtmlTable {
public:
    HtmlTable(std::string_view style, const std::vector<std::string>& columns);
    /// The first cell heads the row.
    void add(const std::vector<std::string>& cells);
    std::string html() const;

private:
    std::string html_;
};

/// A picture in the page; `alt` describes it.
std::string image(std::string_view png, const std::string& alt);

} // namespace stats
