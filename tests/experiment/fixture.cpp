// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "fixture.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <support/file.h>

namespace fixture {

TemporaryFolder::TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "skin2afc-test-XXXXXX").string();
    if (!::mkdtemp(name.data())) {
        throw std::runtime_error("no temporary folder");
    }
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

void write(const fs::path& path, const std::string& text) {
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
}

void append(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary | std::ios::app) << text;
}

std::string read(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

std::vector<std::string> lines_of(const fs::path& path) {
    std::vector<std::string> lines;
    std::istringstream stream(read(path));
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    return lines;
}

std::vector<std::string> files_below(const fs::path& folder) {
    std::vector<std::string> files;
    if (fs::exists(folder)) {
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            if (!entry.is_directory()) {
                files.push_back(fs::relative(entry.path(), folder).string());
            }
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

study::Protocol small_protocol(const fs::path& folder, const std::string& azimuths, double grey_s) {
    const fs::path file = folder / "small.toml";
    write(file, fmt::format("name = \"small\"\n"
                            "shaders = [\"no_sss\", \"ts\"]\n"
                            "[image]\nwidth = 320\nheight = 200\n"
                            "[camera]\ndistances = [{{ name = \"near\", units = 50 }}]\n"
                            "[light]\nazimuths_deg = {}\n"
                            "[session]\ngrey_s = {}\n",
                            azimuths, grey_s));
    return study::read_protocol(file);
}

std::array<std::uint8_t, 3> pixel_of(int picture, int x, int y) {
    // A position code in red and green, the picture's number in blue; no value is that of a page or of the
    // grey.
    return {static_cast<std::uint8_t>(x % 100), static_cast<std::uint8_t>(y % 100),
            static_cast<std::uint8_t>(200 + 3 * picture)};
}

nlohmann::json write_stimuli(const fs::path& folder, const study::Protocol& protocol) {
    fs::create_directories(folder);
    nlohmann::json images = nlohmann::json::array();
    const int width = protocol.image.width;
    const int height = protocol.image.height;
    int picture = 0;
    for (const std::string& shader : protocol.shaders) {
        for (const study::Distance& distance : protocol.camera.distances) {
            for (const int azimuth_deg : protocol.light.azimuths_deg) {
                std::vector<std::uint8_t> pixels;
                for (int y = 0; y < height; ++y) {
                    for (int x = 0; x < width; ++x) {
                        const auto rgb = pixel_of(picture, x, y);
                        pixels.insert(pixels.end(), rgb.begin(), rgb.end());
                    }
                }
                const std::string file = study::stimulus_name(shader, distance.name, azimuth_deg) + ".png";
                const auto output = OIIO::ImageOutput::create("png");
                if (!output->open((folder / file).string(),
                                  OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::UINT8)) ||
                    !output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) || !output->close()) {
                    throw std::runtime_error(output->geterror());
                }
                images.push_back({{"shader", shader},
                                  {"distance", distance.name},
                                  {"azimuth_deg", azimuth_deg},
                                  {"file", file},
                                  {"sha256", support::sha256_of_file(folder / file)}});
                ++picture;
            }
        }
    }
    const nlohmann::json manifest{{"protocol", {{"name", protocol.name}, {"digest", protocol.digest}}},
                                  {"images", images}};
    write(folder / "manifest.json", manifest.dump());
    return manifest;
}

std::vector<Row> read_log(const fs::path& path) {
    const auto cells_of = [](const std::string& line) {
        std::vector<std::string> cells;
        std::istringstream stream(line);
        for (std::string cell; std::getline(stream, cell, '\t');) {
            cells.push_back(cell);
        }
        return cells;
    };
    const auto lines = lines_of(path);
    std::vector<Row> rows;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const auto names = cells_of(lines.front());
        const auto cells = cells_of(lines[i]);
        Row row;
        for (std::size_t column = 0; column < std::min(names.size(), cells.size()); ++column) {
            row[names[column]] = cells[column];
        }
        rows.push_back(row);
    }
    return rows;
}

fs::path log_path(const fs::path& study, const std::string& label, int run) {
    return study / ("sub-" + label) / "beh" /
           fmt::format("sub-{}_task-skin2afc_run-{:02d}_beh.tsv", label, run);
}

pid_t start_program(const std::vector<std::string>& arguments, const fs::path& folder) {
    std::vector<std::string> words{SKIN2AFC_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    const int flags = O_CREAT | O_TRUNC | O_WRONLY;
    ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, (folder / "out.txt").c_str(), flags, 0600);
    ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, (folder / "err.txt").c_str(), flags, 0600);
    pid_t pid = 0;
    const int error = ::posix_spawn(&pid, SKIN2AFC_PROGRAM, &actions, nullptr, argv.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    if (error != 0) {
        throw std::runtime_error("cannot start " SKIN2AFC_PROGRAM);
    }
    return pid;
}

Outcome wait_for_program(pid_t pid, const fs::path& folder) {
    int status = 0;
    ::waitpid(pid, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(folder / "out.txt"), read(folder / "err.txt")};
}

Outcome run_program(const std::vector<std::string>& arguments) {
    const TemporaryFolder folder;
    return wait_for_program(start_program(arguments, folder.path()), folder.path());
}

} // namespace fixture
