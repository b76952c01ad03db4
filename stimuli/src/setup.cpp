// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stimuli/setup.h>

#include <glm/glm.hpp>

#include <renderer/optics/burley.h>
#include <renderer/optics/dipole.h>
#include <renderer/scene/gltf.h>
#include <stimuli/head.h>

#include "arrangement.h"

namespace stimuli {
namespace {

namespace fs = std::filesystem;
namespace passes = renderer::passes;
namespace scene = renderer::scene;

glm::vec3 vec(const study::Rgb& rgb) { return {rgb[0], rgb[1], rgb[2]}; }

/// The model as it stands in the file.
scene::Model unrefined_model(const study::Protocol& protocol, const std::optional<fs::path>& file) {
    const study::ModelSettings& settings = protocol.model;
    fs::path path;
    if (file) {
        path = *file;
    } else if (settings.file) {
        path = protocol.file.parent_path() / *settings.file;
    } else {
        return builtin_head();
    }
    scene::ModelOverrides overrides;
    const auto beside = [&](const std::optional<fs::path>& texture) -> std::optional<fs::path> {
        return texture ? std::optional<fs::path>(path.parent_path() / *texture) : std::nullopt;
    };
    overrides.base_color = beside(settings.base_color);
    overrides.normal = beside(settings.normal);
    overrides.roughness = beside(settings.roughness);
    overrides.metres_per_unit = settings.metres_per_unit;
    overrides.flip_v = settings.flip_v;
    return scene::load_gltf(path, overrides);
}

passes::Foreshortening foreshortening(bool exact) {
    return exact ? passes::Foreshortening::exact : passes::Foreshortening::published;
}

passes::Stretch stretch(const study::StretchSettings& settings) {
    passes::Stretch result;
    if (settings.alpha) {
        result.alpha = static_cast<float>(*settings.alpha);
    }
    if (settings.beta) {
        result.beta = static_cast<float>(*settings.beta);
    }
    return result;
}

} // namespace

scene::Model load_head(const study::Protocol& protocol, HeadDetail detail) {
    return arranged(simplified(builtin_head(), detail), protocol);
}

scene::Model load_model(const study::Protocol& protocol, const std::optional<fs::path>& file) {
    scene::Model model = unrefined_model(protocol, file);
    for (scene::Mesh& mesh : model.meshes) {
        scene::refine(mesh, static_cast<float>(protocol.model.longest_edge_mm));
    }
    return arranged(std::move(model), protocol);
}

passes::Look look(const study::Protocol& protocol) {
    passes::Look result;
    result.profile = renderer::optics::profile(protocol.skin.profile);
    result.texture_mix = static_cast<float>(protocol.skin.texture_mix);
    result.specular_intensity = static_cast<float>(protocol.skin.specular_intensity);
    result.fresnel_f0 = static_cast<float>(protocol.skin.fresnel_f0);
    result.roughness = static_cast<float>(protocol.skin.roughness);
    result.bloom_strength = static_cast<float>(protocol.bloom.strength);
    result.bloom_sigma_px = static_cast<float>(protocol.bloom.sigma_px);
    result.aperture_mm = static_cast<float>(protocol.lens.aperture_mm);
    result.focus_mm = static_cast<float>(protocol.lens.focus_mm);
    result.exposure = static_cast<float>(protocol.image.exposure);
    result.background = vec(protocol.image.background);
    result.samples = protocol.image.samples;
    return result;
}

passes::Methods methods(const study::Protocol& protocol) {
    passes::Methods result;
    result.ts.map_size = protocol.ts.map_size;
    result.ts.unblurred_first = protocol.ts.unblurred_first;
    result.ts.culled = protocol.ts.culled;
    result.jittered.taps = protocol.ss_jittered.taps;
    result.jittered.unit_mm = static_cast<float>(protocol.ss_jittered.unit_mm);
    result.jittered.foreshortening = foreshortening(protocol.ss_jittered.exact_foreshortening);
    result.jittered.stretch = stretch(protocol.ss_jittered.stretch);
    const study::FullSettings& full = protocol.ss_full;
    result.full.taps = full.taps;
    result.full.published_taps = full.published_taps;
    result.full.foreshortening = foreshortening(full.exact_foreshortening);
    result.full.reject_gaps = full.reject_gaps;
    result.full.target_bits = full.target_bits;
    result.full.half_resolution = full.half_resolution;
    result.full.unblurred_first = full.unblurred_first;
    result.full.accumulation =
        full.weighted_sum ? passes::Accumulation::weighted_sum : passes::Accumulation::on_the_fly;
    result.full.stretch = stretch(full.stretch);
    return result;
}

passes::Look reference_look(const study::Protocol& protocol) {
    namespace optics = renderer::optics;
    passes::Look result = look(protocol);
    const study::ReferenceSettings& settings = protocol.reference;
    constexpr std::string_view dipole = "dipole_";
    if (settings.profile == "burley") {
        const optics::Burley burley{
            {settings.burley_albedo[0], settings.burley_albedo[1], settings.burley_albedo[2]},
            {settings.burley_mean_free_path_mm[0], settings.burley_mean_free_path_mm[1],
             settings.burley_mean_free_path_mm[2]}};
        result.profile = optics::expanded(burley, settings.profile);
    } else if (settings.profile.starts_with(dipole)) {
        const auto medium = std::string_view(settings.profile).substr(dipole.size());
        result.profile = optics::expanded(optics::measured_medium(medium), settings.profile);
    } else if (!settings.profile.empty()) {
        result.profile = optics::profile(settings.profile);
    }
    return result;
}

renderer::reference::Settings reference_settings(const study::Protocol& protocol) {
    renderer::reference::Settings settings;
    settings.samples_per_side = protocol.reference.samples_per_side;
    settings.cells_per_sigma = protocol.reference.cells_per_sigma;
    return settings;
}

scene::HeadFrame head_frame(const study::Protocol& protocol, const scene::Model& model) {
    const auto height_mm = static_cast<float>(protocol.model.head_height_mm);
    if (protocol.model.head_centre_mm) {
        return {vec(*protocol.model.head_centre_mm), height_mm};
    }
    return scene::top_of(model, height_mm);
}

double distance_mm(const study::Protocol& protocol, const study::Distance& distance) {
    return distance.units * (protocol.model.head_height_mm / protocol.camera.head_units);
}

scene::Camera camera(const study::Protocol& protocol, const study::Distance& distance,
                     const scene::HeadFrame& head) {
    return scene::facing(head, static_cast<float>(distance_mm(protocol, distance)),
                         static_cast<float>(glm::radians(protocol.camera.fov_deg)), protocol.image.width,
                         protocol.image.height);
}

scene::Light light(const study::Protocol& protocol, double azimuth_deg) {
    scene::Light result;
    result.direction = scene::light_direction(static_cast<float>(glm::radians(azimuth_deg)),
                                              static_cast<float>(glm::radians(protocol.light.elevation_deg)));
    result.irradiance = vec(protocol.light.irradiance);
    result.ambient_irradiance = vec(protocol.light.ambient);
    result.shadow_map_size = protocol.light.shadow_map_size;
    result.shadow_softness_mm = static_cast<float>(protocol.light.shadow_softness_mm);
    for (const study::FurtherLight& further : protocol.light.further) {
        result.further.push_back(
            {scene::light_direction(static_cast<float>(glm::radians(further.azimuth_deg)),
                                    static_cast<float>(glm::radians(further.elevation_deg))),
             vec(further.irradiance)});
    }
    return result;
}

} // namespace stimuli
