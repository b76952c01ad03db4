// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <experiment/command.h>
#include <measure/command.h>
#include <stats/command.h>
#include <stimuli/command.h>
#include <support/error.h>

namespace {

constexpr int exit_failed = 1, exit_bad_input = 2;

constexpr const char* footer = R"(DATA FLOW
  protocol.toml -> stimuli -> images + manifest -> session -> log -> analyse -> tables, figures, report

EXAMPLE
  skin2afc stimuli protocols/jimenez2009.toml --out out/stimuli --model head.glb
  skin2afc session protocols/jimenez2009.toml --stimuli out/stimuli --study out/study --participant 01
  skin2afc analyse out/study --out out/analysis

EXIT STATUS
  0  done
  1  the work failed
  2  bad usage or bad input; nothing was half-written

An error is one line on the standard error stream: the file, the field or line, what was expected, what was found.
"skin2afc COMMAND --help" is the manual page of a command; protocols/FORMAT.md describes every file.)";

int fail(int code, const std::string& message) {
    fmt::print(stderr, "skin2afc: {}\n", support::one_line(message));
    return code;
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "skin2afc - render skin stimuli, run two-alternative forced-choice (2AFC) sessions, analyse them",
        "skin2afc"};
    app.set_version_flag("--version", "skin2afc " SKIN2AFC_VERSION);
    app.require_subcommand(1);
    app.footer(footer);
    stimuli::add_command(app);
    experiment::add_command(app);
    stats::add_command(app);
    measure::add_command(app);
    try {
        app.parse(argc, argv);
        return 0;
    } catch (const CLI::Success& request) { // --help, --version
        return app.exit(request);
    } catch (const CLI::ParseError& error) {
        if (app.get_subcommands().empty() && argc > 1 && argv[1][0] != '-') {
            return fail(exit_bad_input,
                        fmt::format("expected a command, found \"{}\" (see --help)", argv[1]));
        }
        return fail(exit_bad_input, fmt::format("{} (see --help)", error.what()));
    } catch (const support::InputError& error) {
        return fail(exit_bad_input, error.what());
    } catch (const std::exception& error) {
        return fail(exit_failed, error.what());
    }
}
