// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <functional>

namespace measure {

/// Milliseconds that OpenGL takes for what `work` asks for, all of it finished: GL_TIME_ELAPSED on a GPU,
/// wall time on a CPU, which does its part while it is asked.
double gl_time_ms(const std::function<void()>& work);

} // namespace measure
