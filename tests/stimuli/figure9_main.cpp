// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

// figure9 PROTOCOL DIR: the errors of Figure 9 for a folder made by `skin2afc stimuli PROTOCOL --out DIR
// --exr`. Ends with 1 if a view is not in the paper's order.

#include <exception>

#include <fmt/format.h>

#include "figure9.h"

int main(int argc, char** argv) {
    if (argc != 3) {
        fmt::print(stderr, "usage: figure9 PROTOCOL DIR\n");
        return 2;
    }
    try {
        bool ordered = true;
        fmt::print("{:<10} {:>10} {:>12} {:>10}\n", "RMSE to ts", "no_sss", "ss_jittered", "ss_full");
        for (const ViewErrors& view : figure9(study::read_protocol(argv[1]), argv[2])) {
            fmt::print("{:<10} {:>10.6f} {:>12.6f} {:>10.6f}{}\n", view.view, view.rmse.at("no_sss"),
                       view.rmse.at("ss_jittered"), view.rmse.at("ss_full"),
                       view.ordered() ? "" : "  not in order");
            ordered = ordered && view.ordered();
        }
        return ordered ? 0 : 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "figure9: {}\n", error.what());
        return 2;
    }
}
