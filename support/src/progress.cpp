// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <support/progress.h>

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace support {

Progress::Progress(std::string label, std::size_t steps)
    : label_(std::move(label)), steps_(steps), terminal_(::isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
    if (terminal_ && done_ > 0) {
        std::fputc('\n', stderr);
    }
}

void Progress::step(std::string_view what) {
    ++done_;
    if (!terminal_) {
        fmt::print(stderr, "{} {}/{} {}\n", label_, done_, steps_, what);
        return;
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    const double left_s =
        done_ < steps_ ? elapsed.count() / static_cast<double>(done_) * static_cast<double>(steps_ - done_)
                       : 0;
    constexpr std::size_t width = 24;
    const std::size_t filled = steps_ > 0 ? width * done_ / steps_ : width;
    fmt::print(stderr, "\r\033[K{} [{:#<{}}{:.<{}}] {}/{} {:.0f} s left  {}", label_, "", filled, "",
               width - filled, done_, steps_, left_s, what);
    std::fflush(stderr);
}

} // namespace support
