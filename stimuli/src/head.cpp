// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stimuli/head.h>

#include <utility>

#include "head_cache.h"
#include "head_maps.h"
#include "head_person.h"
#include "head_surface.h"

namespace stimuli {

renderer::scene::Model sculpt_head(const HeadSettings& settings) {
    const head::Person person(settings);
    const head::Surface surface = head::head_surface(person);
    const head::Atlas atlas(surface);

    renderer::scene::Material skin;
    skin.name = "skin";
    skin.base_color = head::albedo_map(person, atlas);
    skin.normal = head::normal_map(person, atlas);
    skin.roughness = head::reflection_map(person, atlas);
    skin.specular = skin.roughness;
    skin.roughness_factor = 1;

    renderer::scene::Model model;
    model.name = "built-in head";
    model.meshes.push_back(head::head_mesh(surface));
    model.materials.push_back(std::move(skin));
    model.digest = renderer::scene::content_digest(model);
    return model;
}

renderer::scene::Model builtin_head(const HeadSettings& settings) {
    if (auto kept = head::read_cached(settings)) {
        return *std::move(kept);
    }
    renderer::scene::Model model = sculpt_head(settings);
    head::write_cached(settings, model);
    return model;
}

} // namespace stimuli
