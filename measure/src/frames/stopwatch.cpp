// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "stopwatch.h"

#include <chrono>

#include <epoxy/gl.h>

#include <renderer/gl/context.h>

namespace measure {

double gl_time_ms(const std::function<void()>& work) {
    glFinish();
    if (renderer::gl::runs_on_cpu()) {
        const auto start = std::chrono::steady_clock::now();
        work();
        glFinish();
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }
    GLuint query = 0;
    glCreateQueries(GL_TIME_ELAPSED, 1, &query);
    glBeginQuery(GL_TIME_ELAPSED, query);
    work();
    glEndQuery(GL_TIME_ELAPSED);
    GLuint64 elapsed_ns = 0;
    glGetQueryObjectui64v(query, GL_QUERY_RESULT, &elapsed_ns);
    glDeleteQueries(1, &query);
    return 1e-6 * static_cast<double>(elapsed_ns);
}

} // namespace measure
