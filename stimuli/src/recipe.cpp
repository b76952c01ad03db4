// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "recipe.h"

#include <glm/glm.hpp>

#include <support/file.h>

namespace stimuli {
namespace {

using Json = nlohmann::ordered_json;
namespace passes = renderer::passes;
namespace scene = renderer::scene;

glm::vec3 vec(const study::Rgb& rgb) { return {rgb[0], rgb[1], rgb[2]}; }
Json list(const glm::vec3& v) { return {v.x, v.y, v.z}; }

Json stretch_parameters(const study::StretchSettings& stretch) {
    return {{"alpha", stretch.alpha ? Json(*stretch.alpha) : Json("physical")},
            {"beta_px", stretch.beta ? Json(*stretch.beta) : Json("physical")}};
}

/// The parameters that only one shader reads.
Json method_parameters(const study::Protocol& protocol, passes::Shader shader) {
    switch (shader) {
    case passes::Shader::no_sss:
        return Json::object();
    case passes::Shader::ts:
        return {{"map_size", protocol.ts.map_size}, {"unblurred_first", protocol.ts.unblurred_first}};
    case passes::Shader::ss_jittered: {
        Json json = stretch_parameters(protocol.ss_jittered.stretch);
        json["unit_mm"] = protocol.ss_jittered.unit_mm;
        return json;
    }
    case passes::Shader::ss_full:
        return stretch_parameters(protocol.ss_full.stretch);
    }
    return nullptr;
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

passes::Look look(const study::Protocol& protocol) {
    passes::Look result;
    result.profile = renderer::optics::profile(protocol.skin.profile);
    result.texture_mix = static_cast<float>(protocol.skin.texture_mix);
    result.specular_intensity = static_cast<float>(protocol.skin.specular_intensity);
    result.fresnel_f0 = static_cast<float>(protocol.skin.fresnel_f0);
    result.roughness = static_cast<float>(protocol.skin.roughness);
    result.bloom_strength = static_cast<float>(protocol.bloom.strength);
    result.bloom_sigma_px = static_cast<float>(protocol.bloom.sigma_px);
    result.exposure = static_cast<float>(protocol.image.exposure);
    result.background = vec(protocol.image.background);
    result.samples = protocol.image.samples;
    return result;
}

passes::Methods methods(const study::Protocol& protocol) {
    passes::Methods result;
    result.ts_map_size = protocol.ts.map_size;
    result.ts_unblurred_first = protocol.ts.unblurred_first;
    result.jitter_unit_mm = static_cast<float>(protocol.ss_jittered.unit_mm);
    result.jitter_stretch = stretch(protocol.ss_jittered.stretch);
    result.full_stretch = stretch(protocol.ss_full.stretch);
    return result;
}

scene::HeadFrame head_frame(const study::Protocol& protocol, const scene::Model& model) {
    const auto height_mm = static_cast<float>(protocol.model.head_height_mm);
    if (protocol.model.head_centre_mm) {
        return {vec(*protocol.model.head_centre_mm), height_mm};
    }
    return scene::top_of(model, height_mm);
}

Recipe recipe(const Item& item, const study::Protocol& protocol, const scene::Model& model,
              const scene::HeadFrame& head, const std::string& driver) {
    Recipe result;
    result.shader = *passes::shader_of(item.shader);
    const double unit_mm = protocol.model.head_height_mm / protocol.camera.head_units;
    const double distance_mm = item.distance.units * unit_mm;
    result.camera = scene::facing(head, static_cast<float>(distance_mm),
                                  static_cast<float>(glm::radians(protocol.camera.fov_deg)),
                                  protocol.image.width, protocol.image.height);
    result.light.direction =
        scene::light_direction(static_cast<float>(glm::radians(static_cast<double>(item.azimuth_deg))),
                               static_cast<float>(glm::radians(protocol.light.elevation_deg)));
    result.light.irradiance = vec(protocol.light.irradiance);
    result.light.ambient_irradiance = vec(protocol.light.ambient);
    result.light.shadow_map_size = protocol.light.shadow_map_size;
    result.light.shadow_softness_mm = static_cast<float>(protocol.light.shadow_softness_mm);

    result.parameters = Json{
        {"shader", item.shader},
        {"method", method_parameters(protocol, result.shader)},
        {"model", model.digest},
        {"longest_edge_mm", protocol.model.longest_edge_mm},
        {"width", protocol.image.width},
        {"height", protocol.image.height},
        {"samples", protocol.image.samples},
        {"background", protocol.image.background},
        {"exposure", protocol.image.exposure},
        {"fov_deg", protocol.camera.fov_deg},
        {"distance_mm", distance_mm},
        {"head_centre_mm", list(head.centre_mm)},
        {"elevation_deg", protocol.light.elevation_deg},
        {"azimuth_deg", item.azimuth_deg},
        {"irradiance", protocol.light.irradiance},
        {"ambient", protocol.light.ambient},
        {"shadow_map_size", protocol.light.shadow_map_size},
        {"shadow_softness_mm", protocol.light.shadow_softness_mm},
        {"profile", protocol.skin.profile},
        {"texture_mix", protocol.skin.texture_mix},
        {"specular_intensity", protocol.skin.specular_intensity},
        {"fresnel_f0", protocol.skin.fresnel_f0},
        {"roughness", protocol.skin.roughness},
        {"bloom_strength", protocol.bloom.strength},
        {"bloom_sigma_px", protocol.bloom.sigma_px},
        {"shader_code", passes::shader_code_digest()},
        {"driver", driver},
    };
    result.digest = support::sha256(result.parameters.dump());
    return result;
}

} // namespace stimuli
