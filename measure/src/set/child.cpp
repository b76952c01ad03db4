// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "child.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <support/error.h>
#include <support/file.h>

#include "../scratch_folder.h"

namespace measure {
namespace {

namespace fs = std::filesystem;

/// Where a child's streams go.
class Streams {
public:
    explicit Streams(const fs::path& errors) {
        ::posix_spawn_file_actions_init(&actions_);
        ::posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        ::posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT,
                                           0600);
    }
    ~Streams() { ::posix_spawn_file_actions_destroy(&actions_); }
    Streams(const Streams&) = delete;
    Streams& operator=(const Streams&) = delete;
    const posix_spawn_file_actions_t* get() const { return &actions_; }

private:
    posix_spawn_file_actions_t actions_;
};

std::string last_line(std::string text) {
    while (text.ends_with('\n')) {
        text.pop_back();
    }
    return text.substr(text.rfind('\n') + 1);
}

} // namespace

void run_program(const fs::path& program, const std::vector<std::string>& arguments) {
    const ScratchFolder scratch;
    const fs::path errors = scratch.path() / "errors";
    const Streams streams(errors);
    std::string name = program.string();
    std::vector<std::string> copies = arguments;
    std::vector<char*> argv{name.data()};
    for (std::string& argument : copies) {
        argv.push_back(argument.data());
    }
    argv.push_back(nullptr);
    pid_t child = 0;
    const int error = ::posix_spawn(&child, program.c_str(), streams.get(), nullptr, argv.data(), environ);
    if (error != 0) {
        throw support::failure("{}: cannot be run: {}", program.string(), std::strerror(error));
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        const std::string said = fs::exists(errors) ? last_line(support::read_text(errors)) : "";
        throw support::failure("{} {}: expected to end with status 0, found {}: {}", program.string(),
                               fmt::join(arguments, " "), WIFEXITED(status) ? WEXITSTATUS(status) : -1,
                               support::one_line(said));
    }
}

} // namespace measure
