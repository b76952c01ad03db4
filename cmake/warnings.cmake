# SPDX-FileCopyrightText: 2026 The skin2afc authors
# SPDX-License-Identifier: MIT

# Warnings as errors, for the project's own targets only.
add_library(project_warnings INTERFACE)
target_compile_options(project_warnings INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror)
target_compile_features(project_warnings INTERFACE cxx_std_20)

# A library with its public headers in include/ and its sources in src/.
function(skin2afc_library name)
    cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
    add_library(${name} STATIC ${ARG_SOURCES})
    target_include_directories(${name} PUBLIC include PRIVATE src)
    target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE} $<BUILD_INTERFACE:project_warnings>)
endfunction()
