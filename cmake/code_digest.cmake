# SPDX-FileCopyrightText: 2026 The skin2afc authors
# SPDX-License-Identifier: MIT

# Define CODE_DIGEST for one source file: the SHA-256 of all sources in the folders, so that images know by which code
# they were made.
function(code_digest source)
    set(digests "")
    foreach(folder IN LISTS ARGN)
        get_filename_component(folder ${folder} ABSOLUTE)
        file(GLOB code ${folder}/*.cpp ${folder}/*.h)
        foreach(file IN LISTS code)
            file(SHA256 ${file} digest)
            string(APPEND digests ${digest})
        endforeach()
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${code})
    endforeach()
    string(SHA256 digest "${digests}")
    set_source_files_properties(${source} PROPERTIES COMPILE_DEFINITIONS "CODE_DIGEST=\"${digest}\"")
endfunction()
