# SPDX-FileCopyrightText: 2026 The skin2afc authors
# SPDX-License-Identifier: MIT

# Run with -P: write OUTPUT, a C++ source that holds the text of each shader in SHADERS (a ;-list of paths).
set(text "// Made by cmake/embed_shaders.cmake; do not edit.\n\n#include \"shader_library.h\"\n\n")
string(APPEND text "namespace renderer::passes {\n\nconst std::map<std::string, std::string>& shader_sources() {\n")
string(APPEND text "    static const std::map<std::string, std::string> sources{\n")
foreach(shader IN LISTS SHADERS)
    get_filename_component(name ${shader} NAME)
    file(READ ${shader} source)
    string(APPEND text "        {\"${name}\", R\"GLSL(${source})GLSL\"},\n")
endforeach()
string(APPEND text "    };\n    return sources;\n}\n\n} // namespace renderer::passes\n")
file(WRITE ${OUTPUT} "${text}")
