// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "interruption.h"

#include <cstring>

#include <fmt/format.h>

#include "stage.h"

namespace experiment {
namespace {

constexpr std::array<int, 3> signals{SIGINT, SIGTERM, SIGHUP};
volatile std::sig_atomic_t arrived = 0;

extern "C" void remember(int signal) { arrived = signal; }

} // namespace

Interruption::Interruption() {
    arrived = 0;
    struct sigaction action {};
    action.sa_handler = remember;
    for (std::size_t i = 0; i < signals.size(); ++i) {
        ::sigaction(signals[i], &action, &previous_[i]);
    }
}

Interruption::~Interruption() {
    for (std::size_t i = 0; i < signals.size(); ++i) {
        ::sigaction(signals[i], &previous_[i], nullptr);
    }
}

void Interruption::check() {
    if (arrived != 0) {
        throw Interrupted(fmt::format("the program was asked to stop ({})", ::strsignal(arrived)));
    }
}

} // namespace experiment
