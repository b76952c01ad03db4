// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "frame_table.h"

#include <cstdio>

#include <fmt/format.h>

#include <support/error.h>
#include <support/file.h>

namespace experiment {

FrameTable::~FrameTable() {
    if (!file_) {
        return;
    }
    try {
        std::string text = "trial\tpicture\tasked\tswap_began\tonset\tmissed_frames\n";
        const auto flips = stage_.flips();
        const double start_s = flips.empty() ? 0 : flips.front().onset_s;
        for (const Flip& flip : flips) {
            text += fmt::format("{}\t{}\t{:.6f}\t{:.6f}\t{:.6f}\t{}\n", flip.trial, flip.picture,
                                flip.asked_s - start_s, flip.called_s - start_s, flip.onset_s - start_s,
                                flip.missed_frames);
        }
        support::write_atomically(*file_, text);
    } catch (const std::exception& error) {
        fmt::print(stderr, "skin2afc: warning: {}\n", support::one_line(error.what()));
    }
}

} // namespace experiment
