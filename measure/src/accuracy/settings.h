// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

#include <renderer/passes/pipeline.h>
#include <study/protocol.h>

namespace measure {

/// protocols/jimenez2009.toml as it was when the program was built, for where no protocol is given.
study::Protocol study_of_2009();
std::string_view study_of_2009_text();

/// One shader as a user could set it.
struct Setting {
    renderer::passes::Shader shader = renderer::passes::Shader::no_sss;
    std::string name; ///< what differs from the shader's default
    renderer::passes::Methods methods;
    std::string profile; ///< name of the sum of Gaussians that it renders with
};

/// no_sss, and for each other shader the protocol's own setting, every other value of one axis at a time, and
/// the published and some cheap or careful combinations. `quick`: fewer of each.
std::vector<Setting> settings(const study::Protocol& protocol, bool quick);

} // namespace measure
