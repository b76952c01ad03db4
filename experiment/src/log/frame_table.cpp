// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "frame_table.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

#include <fmt/format.h>
#include <unistd.h>

#include <support/error.h>
#include <support/file.h>

namespace experiment {

namespace {

constexpr std::string_view header =
    "trial\tpicture\tasked\tswap_began\tonset\tmissed_frames\tpart\tframe\trun\n";

} // namespace

void FrameTable::check(const fs::path& file, bool resumes, const std::string& run) {
    const fs::path folder = fs::absolute(file).parent_path();
    std::error_code unknown;
    if (!fs::is_directory(folder, unknown) || ::access(folder.c_str(), W_OK | X_OK) != 0) {
        throw support::input_error("--frames: {}: expected a name in a folder that can be written, found: {}",
                                   file.string(), std::strerror(errno));
    }
    if (!fs::exists(file)) {
        return;
    }
    const std::string text = resumes && fs::is_regular_file(file) ? support::read_text(file) : "";
    if (!text.starts_with(header) || (text != header && !text.ends_with("\t" + run + "\n"))) {
        throw support::input_error("--frames: {}: expected a name that is free{}, found a file",
                                   file.string(), resumes ? ", or the table of the run" : "");
    }
}

void FrameTable::write() {
    if (!file_) {
        return;
    }
    std::error_code unknown;
    std::string text(fs::exists(*file_, unknown) ? "" : header);
    const auto flips = stage_.flips();
    const double start_s = flips.empty() ? 0 : flips.front().onset_s;
    for (std::size_t i = written_; i < flips.size(); ++i) {
        const Flip& flip = flips[i];
        text += fmt::format("{}\t{}\t{:.6f}\t{:.6f}\t{:.6f}\t{}\t{}\t{}\t{}\n", flip.trial, flip.picture,
                            flip.asked_s - start_s, flip.called_s - start_s, flip.onset_s - start_s,
                            flip.missed_frames, part_, flip.frame, run_);
    }
    std::ofstream stream(*file_, std::ios::app | std::ios::binary);
    stream << text << std::flush;
    if (stream) {
        written_ = flips.size();
    } else {
        fmt::print(stderr, "skin2afc: warning: --frames: {} cannot be written\n", file_->string());
    }
}

} // namespace experiment
