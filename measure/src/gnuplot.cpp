// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "gnuplot.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <spawn.h>
#include <sys/wait.h>

#include <support/error.h>
#include <support/file.h>

#include "scratch_folder.h"

extern char** environ;

namespace measure {

namespace fs = std::filesystem;

std::string gnuplot_svg(const std::string& script) {
    const ScratchFolder folder;
    const fs::path script_file = folder.path() / "script", svg_file = folder.path() / "figure.svg";
    support::write_atomically(script_file, "set output '" + svg_file.string() + "'\n" + script);
    const std::string argument = script_file.string();
    const std::array<const char*, 4> arguments{"gnuplot", "--default-settings", argument.c_str(), nullptr};
    pid_t process = 0;
    const int error = ::posix_spawnp(&process, arguments[0], nullptr, nullptr,
                                     const_cast<char* const*>(arguments.data()), environ);
    if (error != 0) {
        throw support::failure(
            "gnuplot: expected the program on PATH (Debian package gnuplot-nox), found: {}",
            std::strerror(error));
    }
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || !fs::exists(svg_file)) {
        throw support::Failure("gnuplot: expected an SVG figure, found an error");
    }
    return support::read_text(svg_file);
}

} // namespace measure
