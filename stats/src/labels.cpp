// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "labels.h"

#include <cmath>

#include <fmt/format.h>

namespace stats {

std::string shader_label(const std::string& shader) {
    return shader == "ts"            ? "TS"
           : shader == "no_sss"      ? "No SSS"
           : shader == "ss_jittered" ? "SS Jittered"
           : shader == "ss_full"     ? "SS Full"
                                     : shader;
}

std::string distance_label(const std::string& distance) {
    std::string label = distance;
    if (!label.empty() && label[0] >= 'a' && label[0] <= 'z') {
        label[0] = static_cast<char>(label[0] - 'a' + 'A');
    }
    return label;
}

std::string azimuth_label(double azimuth_deg) { return exact(azimuth_deg) + "\u00b0"; }

std::string configuration_label(const std::string& reference, const std::string& distance,
                                double azimuth_deg) {
    return fmt::format("{} - {} - {}", shader_label(reference), distance_label(distance),
                       azimuth_label(azimuth_deg));
}

std::string exact(double value) { return std::isnan(value) ? "n/a" : fmt::format("{}", value); }

std::string statistic_text(double value) {
    std::string text = fmt::format("{:.3f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) {
        text.pop_back();
    }
    return text;
}

std::string p_text(double p) { return p == 1 ? "1" : fmt::format("{:.3f}", p); }

std::string p_phrase(double p) {
    // Just above the level, three digits would show the level itself.
    constexpr double level = 0.05, rounded_to_it = 0.0505;
    if (p > level && p < rounded_to_it) {
        return p < 0.0501 ? "just above 0.05" : fmt::format("= {:.4f}", p);
    }
    return p < 0.0005 ? "< 0.001" : fmt::format("= {:.3f}", p);
}

std::string counted(std::size_t count, std::string_view noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string all_counted(std::size_t count, std::string_view noun) {
    return count == 1 ? fmt::format("the only {}", noun) : "the " + counted(count, noun);
}

std::string listed(std::vector<std::string> items) {
    constexpr std::size_t longest_list = 6;
    if (items.size() > longest_list) {
        const std::size_t others = items.size() - longest_list;
        items.resize(longest_list);
        items.push_back(fmt::format("{} others", others));
    }
    const std::string last = items.back();
    items.pop_back();
    return items.empty() ? last : fmt::format("{} and {}", fmt::join(items, ", "), last);
}

} // namespace stats
