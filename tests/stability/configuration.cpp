// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "configuration.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

#include "models.h"

namespace stability {

namespace passes = renderer::passes;
namespace scene = renderer::scene;
using support::Generator;

namespace {

constexpr double pi = std::numbers::pi;

template <typename T>
T one_of(Generator& random, std::initializer_list<T> choices) {
    return choices.begin()[random.below(choices.size())];
}

float between(Generator& random, double low, double high) {
    return static_cast<float>(low + (high - low) * random.uniform());
}

bool chance(Generator& random, double probability) { return random.uniform() < probability; }

/// 0, 1 or between.
float share(Generator& random) { return one_of(random, {0.0f, 1.0f, between(random, 0, 1)}); }

glm::vec3 random_direction(Generator& random) {
    const glm::vec3 v(random.normal(), random.normal(), random.normal());
    return glm::normalize(v + glm::vec3(0, 0, 1e-6f));
}

glm::vec3 random_color(Generator& random, double low, double high) {
    return glm::vec3(log_uniform(random, low, high), log_uniform(random, low, high),
                     log_uniform(random, low, high));
}

/// One to six Gaussians, some of them of the same width.
renderer::optics::Profile random_profile(Generator& random, double narrowest_mm, double widest_mm) {
    renderer::optics::Profile profile{"random", {}};
    glm::dvec3 sum(0);
    std::vector<double> sigmas_mm;
    for (std::uint64_t i = 0; i < 1 + random.below(6); ++i) {
        sigmas_mm.push_back(chance(random, 0.2) && i > 0 ? sigmas_mm.back()
                                                         : log_uniform(random, narrowest_mm, widest_mm));
    }
    std::sort(sigmas_mm.begin(), sigmas_mm.end());
    for (const double sigma_mm : sigmas_mm) {
        profile.gaussians.push_back(
            {sigma_mm * sigma_mm, glm::dvec3(random.uniform(), random.uniform(), random.uniform())});
        sum += profile.gaussians.back().weight;
    }
    for (renderer::optics::Gaussian& g : profile.gaussians) {
        g.weight /= sum;
    }
    return profile;
}

renderer::optics::Profile published_profile(Generator& random) {
    return renderer::optics::profile(
        one_of(random, {"skin_6g_deon2007", "skin_4g_jimenez2010", "marble_4g_jimenez2010"}));
}

std::string words(const passes::Methods& methods) {
    const passes::FullMethod& full = methods.full;
    return fmt::format("; ts {}{}; jittered {} taps; full {} {}taps, {}foreshortened, {}{} bits{}",
                       methods.ts.map_size, methods.ts.unblurred_first ? " unblurred first" : "",
                       methods.jittered.taps, full.taps, full.published_taps ? "published " : "",
                       full.foreshortening == passes::Foreshortening::exact ? "exactly " : "",
                       full.reject_gaps ? "gaps rejected, " : "", full.target_bits,
                       full.half_resolution ? ", half resolution" : "");
}

passes::Methods random_methods(Generator& random) {
    passes::Methods methods;
    methods.ts.map_size = one_of(random, {64, 65, 128});
    methods.ts.unblurred_first = chance(random, 0.5);
    methods.jittered.taps = one_of(random, {13, 25, 49});
    passes::FullMethod& full = methods.full;
    full = chance(random, 0.25) ? passes::published_full() : passes::FullMethod{};
    if (!full.published_taps) {
        full.taps = one_of(random, {7, 9, 13, 25});
        full.foreshortening =
            one_of(random, {passes::Foreshortening::published, passes::Foreshortening::exact});
        full.reject_gaps = chance(random, 0.5);
    }
    full.target_bits = one_of(random, {0, 16, 32});
    full.half_resolution = chance(random, 0.3);
    return methods;
}

/// Further lights, and maps of texture space sized and lit by what is seen. From a generator of its own, so
/// that configurations found earlier stay what they were.
void add_more(Case& given, std::string_view kind, std::uint64_t index, std::uint64_t most_lights) {
    Generator random(fmt::format("stability, {}, more", kind), index);
    for (std::uint64_t i = random.below(1 + most_lights); i > 0; --i) {
        const glm::vec3 color = random_color(random, 1e-6, 1e6);
        given.light.further.push_back({random_direction(random), chance(random, 0.1) ? glm::vec3(0) : color});
    }
    given.methods.ts.culled = chance(random, 0.4);
    given.name += fmt::format("; {} further lights{}", given.light.further.size(),
                              given.methods.ts.culled ? ", ts culled" : "");
}

scene::Model hostile_model(Generator& random, float scale, std::string& words) {
    const auto kind = random.below(5);
    const auto damage = static_cast<Damage>(chance(random, 0.4) ? 0 : random.below(damages));
    const float size_mm = 100 * scale;
    scene::Model model = kind == 0   ? square(size_mm, 1 + static_cast<int>(random.below(4)))
                         : kind == 1 ? step(size_mm, size_mm * between(random, 0, 1))
                         : kind == 2 ? soup(size_mm, 1 + static_cast<int>(random.below(60)), random)
                                     : dented_sphere(0.5f * size_mm, kind == 3 ? 0.0f : 0.3f, 24, 12);
    words += fmt::format("{} of {} mm with {}", model.name, size_mm, name(damage));
    spoil(model, damage, random);
    scene::Material& material = model.materials[0];
    material.base_color = chance(random, 0.5) ? noise_image(16, 8, random) : nullptr;
    material.normal = chance(random, 0.5) ? noise_image(8, 5, random) : nullptr;
    material.roughness = chance(random, 0.5) ? noise_image(1, 9, random) : nullptr;
    material.base_color_factor = {share(random), share(random), share(random)};
    material.normal_scale = one_of(random, {0.0f, 1.0f, 5.0f});
    material.roughness_factor = one_of(random, {-1.0f, 0.0f, 1.0f, 0.5f});
    material.double_sided = chance(random, 0.3);
    return model;
}

passes::Look hostile_look(Generator& random) {
    passes::Look look;
    look.profile = chance(random, 0.3) ? published_profile(random) : random_profile(random, 1e-3, 1000);
    if (chance(random, 0.2)) {
        look.profile.gaussians.front().variance_mm2 = 0;
    }
    look.texture_mix = one_of(random, {0.0f, 0.5f, 1.0f});
    look.specular_intensity = share(random);
    look.fresnel_f0 = one_of(random, {0.0f, 0.028f, 1.0f});
    look.roughness = one_of(random, {0.0f, 0.3f, 1.0f});
    look.bloom_strength = share(random);
    look.bloom_sigma_px = one_of(random, {0.0f, 0.01f, 0.5f, 8.0f, 300.0f});
    look.exposure = static_cast<float>(chance(random, 0.1) ? 0 : log_uniform(random, 1e-6, 1e6));
    look.background = chance(random, 0.5) ? glm::vec3(0) : random_color(random, 1e-6, 1e6);
    look.samples = one_of(random, {1, 4});
    return look;
}

passes::Light hostile_light(Generator& random) {
    passes::Light light;
    light.direction =
        chance(random, 0.2) ? glm::vec3(0, one_of(random, {-1.0f, 1.0f}), 0) : random_direction(random);
    light.irradiance = chance(random, 0.1) ? glm::vec3(0) : random_color(random, 1e-6, 1e6);
    light.ambient_irradiance = chance(random, 0.4) ? glm::vec3(0) : random_color(random, 1e-6, 1e6);
    light.shadow_map_size = one_of(random, {1, 5, 64, 128});
    light.shadow_softness_mm = static_cast<float>(one_of(random, {0.0, 1.0, log_uniform(random, 1e-3, 1e3)}));
    return light;
}

scene::Camera hostile_camera(Generator& random, float scale) {
    scene::Camera camera;
    const float size_mm = 100 * scale;
    camera.target_mm = chance(random, 0.5) ? glm::vec3(0) : random_direction(random) * (0.5f * size_mm);
    glm::vec3 from =
        chance(random, 0.15) ? glm::vec3(0, one_of(random, {-1.0f, 1.0f}), 0) : random_direction(random);
    // From 1 cm to 100 m before the surface, or close to it by the model's own measure, or inside the model.
    const double distance_mm = chance(random, 0.6)
                                   ? log_uniform(random, 10, 1e5)
                                   : static_cast<double>(size_mm) * log_uniform(random, 1e-6, 10);
    camera.eye_mm = camera.target_mm + from * static_cast<float>(distance_mm);
    if (chance(random, 0.05)) {
        camera.target_mm = camera.eye_mm;
    }
    // Half of the cameras frame the model, the others see it as it comes.
    const double framing_deg = 2 * std::atan(0.6 * static_cast<double>(size_mm) / distance_mm) * 180 / pi;
    const double fov_deg = chance(random, 0.5) ? std::clamp(framing_deg, 1.0, 150.0)
                                               : one_of(random, {1.0, 150.0, log_uniform(random, 1, 150)});
    camera.fov_rad = static_cast<float>(fov_deg * pi / 180);
    camera.width = one_of(random, {1, 2, 33, 64, static_cast<int>(1 + random.below(128))});
    camera.height = one_of(random, {1, 3, 48, 95, static_cast<int>(1 + random.below(128))});
    return camera;
}

} // namespace

double log_uniform(Generator& random, double low, double high) {
    return low * std::pow(high / low, random.uniform());
}

Case hostile(std::uint64_t index) {
    Generator random("stability, hostile", index);
    Case given;
    const auto scale = static_cast<float>(one_of(random, {1e-3, 1.0, 1e3, log_uniform(random, 1e-3, 1e3)}));
    given.name = fmt::format("hostile {}: ", index);
    given.model = hostile_model(random, scale, given.name);
    given.look = hostile_look(random);
    given.light = hostile_light(random);
    given.camera = hostile_camera(random, scale);
    given.methods = random_methods(random);
    given.methods.ts.map_size = one_of(random, {1, 2, 7, 64, 129});
    given.methods.jittered.unit_mm =
        static_cast<float>(one_of(random, {0.0, 0.527, log_uniform(random, 1e-3, 1e3)}));
    given.methods.full.target_bits = one_of(random, {0, 8, 16, 32});
    for (passes::Stretch* stretch : {&given.methods.full.stretch, &given.methods.jittered.stretch}) {
        if (chance(random, 0.2)) {
            stretch->alpha = static_cast<float>(one_of(random, {0.0, 11.0, 1e6}));
            stretch->beta = static_cast<float>(one_of(random, {0.0, 800.0, 1e6}));
        }
    }
    const scene::Camera& camera = given.camera;
    given.name += fmt::format("; {}x{}, field of view {} rad, from {} {} {} to {} {} {}", camera.width,
                              camera.height, camera.fov_rad, camera.eye_mm.x, camera.eye_mm.y,
                              camera.eye_mm.z, camera.target_mm.x, camera.target_mm.y, camera.target_mm.z);
    given.name += words(given.methods);
    add_more(given, "hostile", index, 2);
    if (chance(random, 0.2)) {
        given.name += "; 10 km away";
        return moved(given, glm::dvec3(random_direction(random)) * 1e7);
    }
    return given;
}

Case ordinary(std::uint64_t index) {
    Generator random("stability, ordinary", index);
    Case given;
    given.name = fmt::format("ordinary {}", index);
    const float dent = one_of(random, {0.0f, 0.1f, 0.2f});
    given.model = chance(random, 0.2) ? step(70, between(random, 5, 30)) : dented_sphere(50, dent, 64, 32);
    if (chance(random, 0.5)) {
        given.model.materials[0].base_color = noise_image(8, 8, random);
    }
    given.model.materials[0].base_color_factor = {0.8f, 0.6f, 0.5f};
    given.look.profile = chance(random, 0.5) ? published_profile(random) : random_profile(random, 0.05, 10);
    given.look.texture_mix = share(random);
    given.look.samples = one_of(random, {1, 4});
    given.look.bloom_strength = one_of(random, {0.0f, 0.2f});
    given.look.bloom_sigma_px = between(random, 0.5, 6);
    given.look.background = chance(random, 0.5) ? glm::vec3(0) : glm::vec3(0.2f, 0.4f, 0.3f);
    given.methods = random_methods(random);
    // In front of the model, somewhat above or below, so that a step is seen from its front.
    const double azimuth = pi * (random.uniform() - 0.5) * 0.7;
    const double elevation = pi * (random.uniform() - 0.5) * 0.5;
    const float distance_mm = between(random, 120, 400);
    given.camera.eye_mm =
        scene::light_direction(static_cast<float>(azimuth), static_cast<float>(elevation)) * distance_mm;
    given.camera.target_mm = {between(random, -10, 10), between(random, -10, 10), 0};
    given.camera.fov_rad = 2 * std::atan(between(random, 25, 90) / distance_mm);
    given.camera.width = 24 + static_cast<int>(random.below(60));
    given.camera.height = 24 + static_cast<int>(random.below(60));
    given.light.direction = scene::light_direction(static_cast<float>(azimuth) + between(random, -2, 2),
                                                   between(random, -1, 1.2));
    given.light.irradiance = glm::vec3(2.5f, 2.4f, 2.2f) * between(random, 0.3, 1);
    given.light.ambient_irradiance = glm::vec3(between(random, 0, 0.5));
    given.light.shadow_map_size = 128;
    given.light.shadow_softness_mm = one_of(random, {0.0f, 1.0f, 4.0f});
    given.name += words(given.methods);
    add_more(given, "ordinary", index,
             0); // each shadow's edge takes pixels out of the comparisons' allowance
    return given;
}

Case even(std::uint64_t index) {
    Generator random("stability, even", index);
    Case given;
    const double scale = log_uniform(random, 1e-3, 1e3);
    given.model = square(static_cast<float>(100 * scale), 5 + static_cast<int>(random.below(6)));
    const auto damage =
        one_of(random, {Damage::none, Damage::none, Damage::zero_normals, Damage::zero_tangents,
                        Damage::degenerate_triangles, Damage::collapsed_uvs});
    spoil(given.model, damage, random);
    given.model.materials[0].base_color_factor = {share(random), share(random), share(random)};
    given.look.profile = chance(random, 0.5) ? published_profile(random) : random_profile(random, 1e-3, 1000);
    given.look.texture_mix = share(random);
    given.look.specular_intensity = 0;
    given.look.background = glm::vec3(between(random, 0, 1));
    given.look.samples = one_of(random, {1, 4});
    given.methods = random_methods(random);
    given.light.direction =
        glm::normalize(scene::light_direction(between(random, -1.4, 1.4), between(random, -1.4, 1.4)));
    given.light.irradiance = random_color(random, 1e-6, 1e6);
    given.light.ambient_irradiance = chance(random, 0.5) ? glm::vec3(0) : random_color(random, 1e-6, 1e6);
    given.light.shadow_map_size = one_of(random, {16, 64, 256});
    given.light.shadow_softness_mm = static_cast<float>(scale * log_uniform(random, 0.01, 10));
    // From 1 cm to 100 m, if the model is large enough to be seen there; anywhere in front of it.
    const double distance_mm = std::clamp(log_uniform(random, 10, 1e5), 10 * scale, 2000 * scale);
    given.camera.target_mm =
        glm::vec3(between(random, -40, 40), between(random, -40, 40), 0) * static_cast<float>(scale);
    given.camera.eye_mm = given.camera.target_mm +
                          scene::light_direction(between(random, -1.2, 1.2), between(random, -1.2, 1.2)) *
                              static_cast<float>(distance_mm);
    given.camera.fov_rad = static_cast<float>(log_uniform(random, 1, 150) * pi / 180);
    given.camera.width = 1 + static_cast<int>(random.below(96));
    given.camera.height = 1 + static_cast<int>(random.below(96));
    given.name = fmt::format("even {}: square of {} mm with {}, from {} mm, field of view {} rad, {}x{}",
                             index, 100 * scale, name(damage), distance_mm, given.camera.fov_rad,
                             given.camera.width, given.camera.height);
    given.name += words(given.methods);
    add_more(given, "even", index, 2);
    return given;
}

glm::vec3 even_light(const Case& given) {
    // Lambert's law on a plane that faces +Z; half of what comes from above reaches a vertical surface.
    glm::dvec3 irradiance = 0.5 * glm::dvec3(given.light.ambient_irradiance);
    for (const scene::Beam& beam : given.light.beams()) {
        irradiance += glm::dvec3(beam.irradiance) * std::max(0.0, static_cast<double>(beam.direction.z));
    }
    return glm::vec3(irradiance * glm::dvec3(given.model.materials[0].base_color_factor) / pi *
                     static_cast<double>(given.look.exposure));
}

glm::vec3 white_level(const Case& given) {
    glm::vec3 irradiance = given.light.ambient_irradiance;
    for (const scene::Beam& beam : given.light.beams()) {
        irradiance += beam.irradiance;
    }
    return irradiance * (given.look.exposure / static_cast<float>(pi));
}

Case patch(std::uint64_t index) {
    Generator random("stability, patch", index);
    Case given;
    const double side_mm = 100 * log_uniform(random, 1e-3, 1e3);
    given.model = square(static_cast<float>(side_mm), 4);
    constexpr int texels = 64;
    auto image = std::make_shared<scene::Image>(scene::Image{texels, texels, 3, {}});
    for (int i = 0; i < texels * texels; ++i) {
        const auto inside = [](int place) { return std::abs(2 * place - texels + 1) < texels / 4; };
        image->pixels.insert(image->pixels.end(), 3, inside(i % texels) && inside(i / texels) ? 255 : 0);
    }
    given.model.materials[0].base_color = image;
    // The patch reaches an eighth of the side from the middle, the image 0.45: three sigmas fit between.
    given.look.profile = random_profile(random, 1e-4 * side_mm, 0.08 * side_mm);
    given.look.texture_mix = 1;
    given.look.specular_intensity = 0;
    given.methods = random_methods(random);
    given.methods.ts.map_size = 128;
    given.methods.jittered.taps = 13;
    given.methods.jittered.unit_mm = static_cast<float>(0.002 * side_mm);
    given.light.irradiance = random_color(random, 1e-6, 1e6);
    given.light.shadow_softness_mm = 0;
    const double distance_mm = side_mm * log_uniform(random, 0.2, 20);
    given.camera.eye_mm.z = static_cast<float>(distance_mm);
    given.camera.fov_rad = static_cast<float>(2 * std::atan(0.45 * side_mm / distance_mm));
    given.camera.width = given.camera.height = 100 + static_cast<int>(random.below(60));
    given.name = fmt::format("patch {}: square of {} mm, from {} mm{}", index, side_mm, distance_mm,
                             words(given.methods));
    return given;
}

} // namespace stability
