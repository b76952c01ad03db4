// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace renderer::scene {

/// A finished image, rows from the top down.
struct Frame {
    int width = 0, height = 0;
    std::vector<std::uint8_t> srgb; ///< RGB, 8 bits, as participants see it
    std::vector<float> linear; ///< RGBA, linear Rec. 709, exposed, before encoding; A is the head's coverage
    std::vector<std::string> passes_run;     ///< nodes computed for this frame
    std::vector<std::string> passes_reused;  ///< nodes whose results an earlier frame had left
    std::vector<std::string> passes_skipped; ///< what was not needed, with the reason
    std::map<std::string, long long> counts; ///< how many triangles, pixels, passes ... were drawn or skipped
};

} // namespace renderer::scene
