// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <study/protocol.h>
#include <sys/types.h>

namespace fixture {

namespace fs = std::filesystem;

/// A new folder that goes with its owner.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const fs::path& path() const { return path_; }
    fs::path operator/(const fs::path& name) const { return path_ / name; }

private:
    fs::path path_;
};

void write(const fs::path& path, const std::string& text);
void append(const fs::path& path, const std::string& text);
std::string read(const fs::path& path);
std::vector<std::string> lines_of(const fs::path& path);
/// Every file below a folder, relative to it, sorted; empty where there is no folder.
std::vector<std::string> files_below(const fs::path& folder);

/// A protocol of 320x200 pixels, no_sss against ts, one distance, these azimuths: two trials an azimuth.
study::Protocol small_protocol(const fs::path& folder, const std::string& azimuths = "[0]",
                               double grey_s = 0.3);

/// The red, green and blue of a test picture at a pixel; every picture has its own.
std::array<std::uint8_t, 3> pixel_of(int picture, int x, int y);
/// Write a picture for each stimulus of the protocol, numbered in the order of shaders, distances, azimuths;
/// and the manifest. Returns the manifest's content.
nlohmann::json write_stimuli(const fs::path& folder, const study::Protocol& protocol);

/// A log's rows by column name.
using Row = std::map<std::string, std::string>;
std::vector<Row> read_log(const fs::path& path);
/// Where a participant's run is.
fs::path log_path(const fs::path& study, const std::string& label, int run = 1);

/// What a finished program left.
struct Outcome {
    int exit_code = -1; ///< -1 if a signal ended it
    std::string out, err;
};
/// Start the program skin2afc with these arguments, its outputs into files of the folder.
pid_t start_program(const std::vector<std::string>& arguments, const fs::path& folder);
Outcome wait_for_program(pid_t pid, const fs::path& folder);
Outcome run_program(const std::vector<std::string>& arguments);

} // namespace fixture
