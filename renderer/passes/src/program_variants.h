// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <map>
#include <string>

#include "shader_library.h"

namespace renderer::passes {

/// Programs of one pair of files that differ in what is #defined, each made when first asked for.
class ProgramVariants {
public:
    ProgramVariants(std::string vertex_file, std::string fragment_file)
        : vertex_file_(std::move(vertex_file)), fragment_file_(std::move(fragment_file)) {}
    const gl::Program& with(const Defines& defines) {
        const auto [place, is_new] = programs_.try_emplace(defines);
        if (is_new) {
            place->second = load_program(vertex_file_, fragment_file_, defines);
        }
        return place->second;
    }

private:
    std::string vertex_file_, fragment_file_;
    std::map<Defines, gl::Program> programs_;
};

} // namespace renderer::passes
