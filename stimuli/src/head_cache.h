// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>

#include <renderer/scene/model.h>
#include <stimuli/head.h>

namespace stimuli::head {

/// The head that this code made from these settings before. Nothing if it has not, or if its file is not what
/// was written.
std::optional<renderer::scene::Model> read_cached(const HeadSettings& settings);

/// Keep the head for next time, and drop the oldest of those kept. Where nothing can be written, nothing is
/// kept.
void write_cached(const HeadSettings& settings, const renderer::scene::Model& model);

} // namespace stimuli::head
