// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "recipe.h"

#include <stimuli/setup.h>
#include <support/file.h>

#include "arrangement.h"

namespace stimuli {
namespace {

using Json = nlohmann::ordered_json;
namespace passes = renderer::passes;
namespace scene = renderer::scene;

Json list(const glm::vec3& v) { return {v.x, v.y, v.z}; }

Json stretch_parameters(const study::StretchSettings& stretch) {
    return {{"alpha", stretch.alpha ? Json(*stretch.alpha) : Json("physical")},
            {"beta_px", stretch.beta ? Json(*stretch.beta) : Json("physical")}};
}

/// The parameters that only one shader reads.
Json method_parameters(const study::Protocol& protocol, std::optional<passes::Shader> shader) {
    if (!shader) {
        const study::ReferenceSettings& reference = protocol.reference;
        Json json{{"samples_per_side", reference.samples_per_side},
                  {"cells_per_sigma", reference.cells_per_sigma}};
        if (!reference.profile.empty()) {
            json["profile"] = reference.profile;
        }
        if (reference.profile == "burley") {
            json["burley_albedo"] = reference.burley_albedo;
            json["burley_mean_free_path_mm"] = reference.burley_mean_free_path_mm;
        }
        return json;
    }
    switch (*shader) {
    case passes::Shader::no_sss:
        return Json::object();
    case passes::Shader::ts:
        return {{"map_size", protocol.ts.map_size},
                {"unblurred_first", protocol.ts.unblurred_first},
                {"culled", protocol.ts.culled}};
    case passes::Shader::ss_jittered: {
        const study::JitteredSettings& jittered = protocol.ss_jittered;
        Json json = stretch_parameters(jittered.stretch);
        json["taps"] = jittered.taps;
        json["unit_mm"] = jittered.unit_mm;
        json["foreshortening"] = jittered.exact_foreshortening ? "exact" : "published";
        return json;
    }
    case passes::Shader::ss_full: {
        const study::FullSettings& full = protocol.ss_full;
        Json json = stretch_parameters(full.stretch);
        json["taps"] = full.taps;
        json["published_taps"] = full.published_taps;
        json["foreshortening"] = full.exact_foreshortening ? "exact" : "published";
        json["reject_gaps"] = full.reject_gaps;
        json["target_bits"] = full.target_bits;
        json["half_resolution"] = full.half_resolution;
        json["unblurred_first"] = full.unblurred_first;
        json["accumulation"] = full.weighted_sum ? "weighted_sum" : "on_the_fly";
        return json;
    }
    }
    return nullptr;
}

/// What most protocols do without.
void add_scene(Json& json, const study::Protocol& protocol) {
    for (const study::FurtherLight& light : protocol.light.further) {
        json["further_lights"].push_back({{"azimuth_deg", light.azimuth_deg},
                                          {"elevation_deg", light.elevation_deg},
                                          {"irradiance", light.irradiance}});
    }
    for (const study::Placement& head : protocol.scene.heads) {
        json["heads"].push_back({{"place_mm", head.place_mm}, {"turn_deg", head.turn_deg}});
    }
    if (const auto& screen = protocol.scene.screen) {
        json["screen"] = {{"z_mm", screen->z_mm},
                          {"width_mm", screen->width_mm},
                          {"height_mm", screen->height_mm},
                          {"albedo", screen_grey},
                          {"head_height_mm", protocol.model.head_height_mm}}; // it stands before the head
    }
    if (protocol.lens.aperture_mm > 0) {
        json["lens"] = {{"aperture_mm", protocol.lens.aperture_mm}, {"focus_mm", protocol.lens.focus_mm}};
    }
    if (!protocol.model.not_skin.empty()) {
        json["not_skin"] = protocol.model.not_skin;
    }
}

} // namespace

Recipe recipe(const Item& item, const study::Protocol& protocol, const scene::Model& model,
              const scene::HeadFrame& head, const std::string& driver) {
    Recipe result;
    result.shader = passes::shader_of(item.shader);
    result.camera = camera(protocol, item.distance, head);
    result.light = light(protocol, item.azimuth_deg);

    result.parameters = Json{
        {"shader", item.shader},
        {"method", method_parameters(protocol, result.shader)},
        {"model", model.digest},
        {"longest_edge_mm", protocol.model.longest_edge_mm},
        {"width", protocol.image.width},
        {"height", protocol.image.height},
        {"background", protocol.image.background},
        {"exposure", protocol.image.exposure},
        {"fov_deg", protocol.camera.fov_deg},
        {"distance_mm", distance_mm(protocol, item.distance)},
        {"head_centre_mm", list(head.centre_mm)},
        {"elevation_deg", protocol.light.elevation_deg},
        {"azimuth_deg", item.azimuth_deg},
        {"irradiance", protocol.light.irradiance},
        {"ambient", protocol.light.ambient},
        {"profile", protocol.skin.profile},
        {"texture_mix", protocol.skin.texture_mix},
        {"specular_intensity", protocol.skin.specular_intensity},
        {"fresnel_f0", protocol.skin.fresnel_f0},
        {"roughness", protocol.skin.roughness},
        {"bloom_strength", protocol.bloom.strength},
        {"bloom_sigma_px", protocol.bloom.sigma_px},
    };
    add_scene(result.parameters, protocol);
    if (result.shader) { // what the reference does not read
        result.parameters["samples"] = protocol.image.samples;
        result.parameters["shadow_map_size"] = protocol.light.shadow_map_size;
        result.parameters["shadow_softness_mm"] = protocol.light.shadow_softness_mm;
        result.parameters["driver"] = driver;
    }
    result.parameters["shader_code"] =
        result.shader ? passes::shader_code_digest() : renderer::reference::code_digest();
    result.digest = support::sha256(result.parameters.dump());
    return result;
}

} // namespace stimuli
