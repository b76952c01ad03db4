// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <tuple>

#include <stimuli/head.h>

/// The built-in head, made once for all tests of it.
inline const renderer::scene::Model& head() {
    static const renderer::scene::Model model = stimuli::builtin_head();
    return model;
}

inline const renderer::scene::Mesh& mesh() { return head().meshes.front(); }

struct PlaceOrder {
    bool operator()(const glm::vec3& a, const glm::vec3& b) const {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    }
};
