// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stimuli/head.h>

#include <string_view>
#include <vector>

#include <support/file.h>

#include "head_maps.h"
#include "head_surface.h"

namespace stimuli {
namespace {

template <typename T>
std::string digest_of(const std::vector<T>& items) {
    return support::sha256({reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T)});
}

/// Digest of all vertices, indices and pixels.
std::string digest_of(const renderer::scene::Mesh& mesh, const renderer::scene::Material& material) {
    static_assert(sizeof(renderer::scene::Vertex) == 12 * sizeof(float), "a vertex has no padding to digest");
    std::string digests = digest_of(mesh.vertices) + digest_of(mesh.indices);
    for (const auto& image : {material.base_color, material.normal, material.roughness}) {
        digests += digest_of(image->pixels);
    }
    return support::sha256(digests);
}

} // namespace

renderer::scene::Model builtin_head() {
    const head::Surface surface = head::head_surface();
    const head::Atlas atlas(surface);

    renderer::scene::Material skin;
    skin.name = "skin";
    skin.base_color = head::albedo_map(atlas);
    skin.normal = head::normal_map(atlas);
    skin.roughness = head::roughness_map(atlas);
    skin.roughness_factor = 1;

    renderer::scene::Model model;
    model.name = "built-in head";
    model.meshes.push_back(head::head_mesh(surface));
    model.digest = digest_of(model.meshes.front(), skin);
    model.materials.push_back(std::move(skin));
    return model;
}

} // namespace stimuli
