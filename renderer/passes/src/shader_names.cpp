// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <array>
#include <utility>

#include <renderer/passes/pipeline.h>

namespace renderer::passes {
namespace {

constexpr std::array<std::pair<Shader, std::string_view>, 4> names{{{Shader::no_sss, "no_sss"},
                                                                    {Shader::ts, "ts"},
                                                                    {Shader::ss_jittered, "ss_jittered"},
                                                                    {Shader::ss_full, "ss_full"}}};

} // namespace

std::string_view shader_name(Shader shader) {
    for (const auto& [value, name] : names) {
        if (value == shader) {
            return name;
        }
    }
    return {};
}

std::optional<Shader> shader_of(std::string_view wanted) {
    for (const auto& [value, name] : names) {
        if (name == wanted) {
            return value;
        }
    }
    return std::nullopt;
}

} // namespace renderer::passes
