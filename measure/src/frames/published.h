// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string_view>

namespace measure {

/// Where a figure stands in frames.tsv: which table, which of its axes, at which value.
struct FramePlace {
    std::string_view table, axis, value;

    bool operator==(const FramePlace&) const = default;
};

/// Frames per second that the papers print [Jimenez2009, Table III; JimenezGutierrez2010, Table 7.2];
/// nothing where they print none. `multisampled`: the highest number of samples rather than one.
std::optional<double> published_fps(const FramePlace& place, std::string_view shader, bool multisampled);

/// The same over that of texture space; for some scenes the papers' text holds this alone.
std::optional<double> published_fps_over_ts(const FramePlace& place, std::string_view shader,
                                            bool multisampled);

} // namespace measure
