// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <support/gnuplot.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <support/error.h>

extern char** environ;

namespace support {
namespace {

/// A nameless file; plain files as the child's streams cannot fill up and block it as pipes do.
class ScratchFile {
public:
    ScratchFile() : file_(std::tmpfile(), &std::fclose) {
        if (!file_) {
            throw failure("a temporary file cannot be made: {}", std::strerror(errno));
        }
    }

    int descriptor() const { return ::fileno(file_.get()); }

    void write(const std::string& text) {
        if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size() ||
            std::fflush(file_.get()) != 0) {
            throw failure("a temporary file cannot be written: {}", std::strerror(errno));
        }
        std::rewind(file_.get());
    }

    std::string read() {
        std::rewind(file_.get());
        std::string text;
        std::array<char, 65536> block;
        while (const auto size = std::fread(block.data(), 1, block.size(), file_.get())) {
            text.append(block.data(), size);
        }
        return text;
    }

private:
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

/// Run a program with its three streams in files; its wait status.
int run(const char* const* arguments, const ScratchFile& in, const ScratchFile& out, const ScratchFile& err) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in.descriptor(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, out.descriptor(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err.descriptor(), STDERR_FILENO);
    pid_t process = 0;
    const int error = ::posix_spawnp(&process, arguments[0], &actions, nullptr,
                                     const_cast<char* const*>(arguments), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error == ENOENT) {
        throw failure("{}: expected the program on PATH (Debian package gnuplot-nox), found none",
                      arguments[0]);
    }
    if (error != 0) {
        throw failure("{}: cannot be started: {}", arguments[0], std::strerror(error));
    }
    int status = 0;
    while (::waitpid(process, &status, 0) < 0) {
        if (errno != EINTR) {
            throw failure("{}: cannot be waited for: {}", arguments[0], std::strerror(errno));
        }
    }
    return status;
}

} // namespace

std::string gnuplot_svg(const std::string& script) {
    ScratchFile in, out, err;
    in.write(script);
    const std::array<const char*, 4> arguments{"gnuplot", "--default-settings", "-", nullptr};
    const int status = run(arguments.data(), in, out, err);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        throw failure("gnuplot: expected a figure, found an error: {}", err.read());
    }
    const std::string svg = out.read();
    if (svg.find("<svg") == std::string::npos || svg.find("</svg>") == std::string::npos) {
        throw Failure("gnuplot: expected an SVG figure, found something else");
    }
    return svg;
}

} // namespace support
