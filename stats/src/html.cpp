// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "html.h"

#include <cstdint>

#include <fmt/format.h>

#include <support/error.h>

namespace stats {

std::string html_text(const std::string& text) {
    std::string out;
    for (const char c : support::one_line(text)) {
        switch (c) {
        case '&':
            out += "&amp;";
            break;
        case '<':
            out += "&lt;";
            break;
        case '>':
            out += "&gt;";
            break;
        case '"':
            out += "&quot;";
            break;
        case '\'':
            out += "&#39;";
            break;
        default:
            out += c;
        }
    }
    return out;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            group = group << 8 | (j < count ? static_cast<unsigned char>(bytes[i + j]) : 0u);
        }
        for (std::size_t j = 0; j < 4; ++j) {
            out += j <= count ? digits[group >> (18 - 6 * j) & 63] : '=';
        }
    }
    return out;
}

std::string paragraph(const std::string& text, std::string_view style) {
    return fmt::format("<p class=\"{}\">{}</p>\n", style, html_text(text));
}

std::string list_of(const std::vector<std::string>& items, std::string_view style) {
    std::string html = fmt::format("<ul class=\"{}\">\n", style);
    for (const std::string& item : items) {
        html += fmt::format("<li>{}</li>\n", html_text(item));
    }
    return html + "</ul>\n";
}

HtmlTable::HtmlTable(std::string_view style, const std::vector<std::string>& columns)
    : html_(fmt::format("<div class=\"scroll\"><table class=\"{}\">\n<thead><tr>", style)) {
    for (const std::string& column : columns) {
        html_ += fmt::format("<th scope=\"col\">{}</th>", column);
    }
    html_ += "</tr></thead>\n<tbody>\n";
}

void HtmlTable::add(const std::vector<std::string>& cells) {
    html_ += fmt::format("<tr><th scope=\"row\">{}</th>", cells.front());
    for (std::size_t i = 1; i < cells.size(); ++i) {
        html_ += fmt::format("<td>{}</td>", cells[i]);
    }
    html_ += "</tr>\n";
}

std::string HtmlTable::html() const { return html_ + "</tbody></table></div>\n"; }

std::string image(std::string_view png, const std::string& alt) {
    return fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", html_text(alt), base64(png));
}

} // namespace stats
