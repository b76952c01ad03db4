// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "shader_library.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include <renderer/passes/pipeline.h>
#include <support/error.h>
#include <support/file.h>

namespace renderer::passes {
namespace {

const std::string& source_of(const std::string& file) {
    const auto found = shader_sources().find(file);
    if (found == shader_sources().end()) {
        throw support::failure("{}: no such shader", file);
    }
    return found->second;
}

/// Replace #include lines by the files they name; errors count lines as "SOURCE:LINE" or "SOURCE(LINE)",
/// SOURCE being the index of the file in `names`.
std::string expanded(const std::string& file, std::vector<std::string>& names) {
    const std::size_t index = names.size();
    names.push_back(file);
    std::istringstream lines(source_of(file));
    std::ostringstream out;
    std::string line;
    constexpr std::string_view directive = "#include \"";
    for (int number = 1; std::getline(lines, line); ++number) {
        if (line.starts_with(directive)) {
            const std::string included = line.substr(directive.size(), line.rfind('"') - directive.size());
            out << "#line 1 " << names.size() << '\n' << expanded(included, names);
            out << "#line " << number + 1 << ' ' << index << '\n';
        } else {
            out << line << '\n';
        }
    }
    return out.str();
}

gl::Stage stage(GLenum kind, const std::string& file) {
    std::vector<std::string> names;
    std::string source = expanded(file, names);
    std::string title = file;
    for (std::size_t i = 1; i < names.size(); ++i) {
        title += fmt::format("{}{} = {}", i == 1 ? ", source " : ", ", i, names[i]);
    }
    return {kind, title, std::move(source)};
}

} // namespace

std::string shader_code_digest() {
    std::string all = CODE_DIGEST;
    for (const auto& [name, source] : shader_sources()) {
        all += name + '\n' + source;
    }
    return support::sha256(all);
}

gl::Program load_program(const std::string& vertex_file, const std::string& fragment_file,
                         const Defines& defines) {
    gl::Stage fragment = stage(GL_FRAGMENT_SHADER, fragment_file);
    std::string lines;
    for (const auto& [name, value] : defines) {
        lines += fmt::format("#define {} {}\n", name, value);
    }
    // After the line #version, which must stand first.
    const std::size_t after_version = fragment.source.find('\n', fragment.source.find("#version")) + 1;
    const auto line = std::count(fragment.source.begin(),
                                 fragment.source.begin() + static_cast<std::ptrdiff_t>(after_version), '\n') +
                      1;
    fragment.source.insert(after_version, lines + fmt::format("#line {} 0\n", line));
    return gl::Program({stage(GL_VERTEX_SHADER, vertex_file), fragment});
}

gl::Program load_screen_program(const std::string& fragment_file, const Defines& defines) {
    return load_program("screen.vert", fragment_file, defines);
}

void draw_screen() { glDrawArrays(GL_TRIANGLES, 0, 3); }

} // namespace renderer::passes
