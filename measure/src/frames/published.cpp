// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "published.h"

#include <array>

namespace measure {
namespace {

struct Fps {
    FramePlace place;
    std::string_view shader;
    double fps, fps_multisampled; // 0: not measured
};

// [Jimenez2009, Table III]: 1280 x 720, 4x MSAA, one light, on a GeForce 8600M GS.
constexpr std::string_view table3 = "table3";
// [JimenezGutierrez2010, Table 7.2]: 1280 x 720, 1x and 8x MSAA, on a GeForce 8600M GS; one head, two lights
// and the medium distance but for what the axis says. Its `ts` is the single pass of Hable et al. 2009.
constexpr std::string_view table7 = "table7_2";

constexpr std::array<Fps, 30> printed{{
    {{table3, "heads", "1"}, "no_sss", 0, 51},       {{table3, "heads", "1"}, "ss_jittered", 0, 42},
    {{table3, "heads", "1"}, "ss_full", 0, 29},      {{table3, "heads", "1"}, "ts", 0, 26},
    {{table3, "heads", "3"}, "no_sss", 0, 41},       {{table3, "heads", "3"}, "ss_jittered", 0, 32},
    {{table3, "heads", "3"}, "ss_full", 0, 24},      {{table3, "heads", "3"}, "ts", 0, 13},
    {{table3, "heads", "5"}, "no_sss", 0, 40},       {{table3, "heads", "5"}, "ss_jittered", 0, 33},
    {{table3, "heads", "5"}, "ss_full", 0, 25},      {{table3, "heads", "5"}, "ts", 0, 9},
    {{table7, "heads", "1"}, "ts", 102, 72},         {{table7, "heads", "1"}, "ss_full", 137, 73},
    {{table7, "heads", "3"}, "ts", 47, 33},          {{table7, "heads", "3"}, "ss_full", 67, 52},
    {{table7, "heads", "5"}, "ts", 29, 21},          {{table7, "heads", "5"}, "ss_full", 50, 38},
    {{table7, "lights", "2"}, "ts", 102, 72},        {{table7, "lights", "2"}, "ss_full", 137, 73},
    {{table7, "lights", "4"}, "ts", 63, 56},         {{table7, "lights", "4"}, "ss_full", 90, 64},
    {{table7, "lights", "6"}, "ts", 54, 43},         {{table7, "lights", "6"}, "ss_full", 69, 54},
    {{table7, "distance", "near"}, "ts", 60, 52},    {{table7, "distance", "near"}, "ss_full", 50, 40},
    {{table7, "distance", "medium"}, "ts", 102, 72}, {{table7, "distance", "medium"}, "ss_full", 137, 73},
    {{table7, "distance", "far"}, "ts", 120, 82},    {{table7, "distance", "far"}, "ss_full", 220, 91},
}};

struct Speedup {
    FramePlace place;
    double fps_over_ts;
};

// [JimenezGutierrez2010, section 7.5, text], at 1x MSAA.
constexpr std::array<Speedup, 4> told{{{{"section7_5", "scene", "ten_heads_far"}, 3.6},
                                       {{"section7_5", "scene", "five_heads_hidden"}, 2.0},
                                       {{"section7_5", "scene", "five_heads_outside"}, 2.0},
                                       {{"section7_5", "scene", "five_busts"}, 2.8}}};

} // namespace

std::optional<double> published_fps(const FramePlace& place, std::string_view shader, bool multisampled) {
    for (const Fps& one : printed) {
        const double fps = multisampled ? one.fps_multisampled : one.fps;
        if (one.place == place && one.shader == shader && fps > 0) {
            return fps;
        }
    }
    return std::nullopt;
}

std::optional<double> published_fps_over_ts(const FramePlace& place, std::string_view shader,
                                            bool multisampled) {
    const auto fps = published_fps(place, shader, multisampled);
    const auto ts = published_fps(place, "ts", multisampled);
    if (fps && ts) {
        return *fps / *ts;
    }
    for (const Speedup& one : told) {
        if (one.place == place && shader == "ss_full" && !multisampled) {
            return one.fps_over_ts;
        }
    }
    return std::nullopt;
}

} // namespace measure
