// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>

#include "../stage.h"

namespace experiment {

namespace fs = std::filesystem;

/// Writes the times of every picture that a stage has shown to a table when it goes, however the session
/// ended.
class FrameTable {
public:
    FrameTable(std::optional<fs::path> file, const Stage& stage) : file_(std::move(file)), stage_(stage) {}
    ~FrameTable();
    FrameTable(const FrameTable&) = delete;
    FrameTable& operator=(const FrameTable&) = delete;

private:
    std::optional<fs::path> file_;
    const Stage& stage_;
};

} // namespace experiment
