// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <utility>

#include "../stage.h"

namespace experiment {

namespace fs = std::filesystem;

/// A table of the times of every picture that a stage has shown; rows are added, none is taken away.
class FrameTable {
public:
    /// Refuse a file that could not be written: in no folder, or taken; a run that is gone on with adds to
    /// its own. Throws support::InputError.
    static void check(const fs::path& file, bool resumes, const std::string& run);

    /// `run` and `part` are written beside the times, which count from the part's first picture.
    FrameTable(std::optional<fs::path> file, const Stage& stage, std::string run, std::size_t part)
        : file_(std::move(file)), stage_(stage), run_(std::move(run)), part_(part) {}
    /// Writes what is left, however the session ended.
    ~FrameTable() { write(); }
    FrameTable(const FrameTable&) = delete;
    FrameTable& operator=(const FrameTable&) = delete;

    /// Add what was shown since the last call, without waiting for the disk. Where that fails, say so; the
    /// next call tries again.
    void write();

private:
    std::optional<fs::path> file_;
    const Stage& stage_;
    std::string run_;
    std::size_t part_, written_ = 0;
};

} // namespace experiment
