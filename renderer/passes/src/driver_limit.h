// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <epoxy/gl.h>

#include <support/error.h>

namespace renderer::passes {

/// Throw support::InputError if what is wanted is more than the driver's limit of that name.
inline void require_limit(const char* what, int wanted, GLenum name) {
    GLint limit = 0;
    glGetIntegerv(name, &limit);
    if (wanted > limit) {
        throw support::input_error("{}: expected at most {}, which this OpenGL driver allows, found {}", what,
                                   limit, wanted);
    }
}

} // namespace renderer::passes
