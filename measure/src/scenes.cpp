// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <measure/scenes.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <support/error.h>

namespace measure {
namespace {

namespace scene = renderer::scene;
using renderer::optics::Profile;

constexpr double pi = std::numbers::pi;
constexpr double plane_mm = 64;       // side of the planes: 16 texels a millimetre
constexpr int texels = 1024;          // of the plane's side
constexpr double from_edge_mm = 6;    // what is compared at an edge of light
constexpr double from_border_mm = 10; // what is left out at the plane's border: beyond the widest kernel
constexpr double dot_mm = 1, around_dot_mm = 3;

/// Integral of the normal distribution function of standard deviation sigma, from minus infinity to x.
double integrated_cdf(double x, double sigma) {
    const double z = x / sigma;
    const double density = std::exp(-z * z / 2) / std::sqrt(2 * pi);
    return x * 0.5 * std::erfc(-z / std::numbers::sqrt2) + sigma * density;
}

/// A step from 0 to 1 at x = 0, blurred by a Gaussian. The step is a texture's: between the middles of two
/// texels it rises along a line, which is a step blurred by a box of one texel.
double blurred_step(double x_mm, double sigma_mm) {
    constexpr double texel_mm = plane_mm / texels;
    return (integrated_cdf(x_mm + texel_mm / 2, sigma_mm) - integrated_cdf(x_mm - texel_mm / 2, sigma_mm)) /
           texel_mm;
}

/// Diffuse light and scattering alone, all colour before scattering.
scene::Look diffuse_look(const Profile& profile) {
    scene::Look look;
    look.profile = profile;
    look.texture_mix = 1;
    look.specular_intensity = 0;
    return look;
}

/// A light along +Z that gives white surfaces whose normals are tilted by so much the radiance 1.
scene::Light frontal_light(double tilt_rad) {
    scene::Light light;
    light.irradiance = glm::vec3(static_cast<float>(pi / std::cos(tilt_rad)));
    light.shadow_softness_mm = 0;
    return light;
}

/// A square about the origin, facing +Z before it is turned about the y axis, white where lit(column, row) of
/// its texture says so.
template <typename Lit>
scene::Model plane(double tilt_rad, const Lit& lit) {
    const auto c = static_cast<float>(std::cos(tilt_rad));
    const auto s = static_cast<float>(std::sin(tilt_rad));
    const glm::mat3 turn(c, 0, -s, 0, 1, 0, s, 0, c);
    constexpr auto h = static_cast<float>(plane_mm / 2);
    scene::Mesh mesh;
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
        mesh.vertices.push_back({turn * glm::vec3(h * corner, 0),
                                 turn * glm::vec3(0, 0, 1),
                                 glm::vec4(turn * glm::vec3(1, 0, 0), 1),
                                 {0.5f + 0.5f * corner.x, 0.5f - 0.5f * corner.y}});
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.has_uv = true;
    auto image = std::make_shared<scene::Image>(scene::Image{texels, texels, 3, {}});
    for (int row = 0; row < texels; ++row) {
        for (int column = 0; column < texels; ++column) {
            image->pixels.insert(image->pixels.end(), 3,
                                 lit(column, row) ? std::uint8_t{255} : std::uint8_t{0});
        }
    }
    scene::Model model;
    model.name = "plane";
    model.materials.emplace_back();
    model.materials[0].base_color = std::move(image);
    model.meshes.push_back(std::move(mesh));
    return model;
}

/// Where the ray through a place of the image meets the plane, in millimetres along its sides; nothing near
/// its border.
std::optional<glm::dvec2> place_on_plane(const scene::Camera& camera, double tilt_rad, double x_px,
                                         double y_px) {
    const glm::dvec3 eye(camera.eye_mm);
    const auto focal_px = static_cast<double>(camera.focal_px());
    const glm::dvec3 ray((x_px - 0.5 * camera.width) / focal_px, (0.5 * camera.height - y_px) / focal_px, -1);
    const glm::dvec3 along(std::cos(tilt_rad), 0, -std::sin(tilt_rad));
    const glm::dvec3 normal(std::sin(tilt_rad), 0, std::cos(tilt_rad));
    const glm::dvec3 hit = eye - glm::dot(eye, normal) / glm::dot(ray, normal) * ray;
    const glm::dvec2 place(glm::dot(hit, along), hit.y);
    const double inside = plane_mm / 2 - from_border_mm;
    return glm::dot(ray, normal) < 0 && std::max(std::abs(place.x), std::abs(place.y)) < inside
               ? std::optional(place)
               : std::nullopt;
}

} // namespace

ClosedForm half_lit_plane(const Profile& profile, double tilt_deg) {
    const double tilt_rad = glm::radians(tilt_deg);
    ClosedForm result;
    result.name =
        tilt_deg == 0 ? "half-lit plane" : "half-lit plane, " + std::to_string(std::lround(tilt_deg)) + "°";
    result.model = plane(tilt_rad, [](int column, int) { return column < texels / 2; });
    result.look = diffuse_look(profile);
    result.light = frontal_light(tilt_rad);
    result.truth = [=](const scene::Camera& camera, double x_px, double y_px) -> std::optional<glm::dvec3> {
        const auto place = place_on_plane(camera, tilt_rad, x_px, y_px);
        if (!place || std::abs(place->x) > from_edge_mm) {
            return std::nullopt;
        }
        glm::dvec3 sum(0);
        for (const auto& g : profile.gaussians) {
            sum += g.weight * blurred_step(-place->x, std::sqrt(g.variance_mm2));
        }
        return sum;
    };
    return result;
}

ClosedForm lit_dot(const Profile& profile) {
    constexpr int low = texels / 2 - static_cast<int>(dot_mm / plane_mm * texels) / 2;
    constexpr int high = texels - low;
    const auto inside = [](int i) { return i >= low && i < high; };
    ClosedForm result;
    result.name = "lit dot";
    result.model = plane(0, [&](int column, int row) { return inside(column) && inside(row); });
    result.look = diffuse_look(profile);
    result.light = frontal_light(0);
    const auto light_at = [=](const glm::dvec2& place) {
        glm::dvec3 sum(0);
        for (const auto& g : profile.gaussians) {
            const auto share = [&](double x) {
                const double sigma = std::sqrt(g.variance_mm2);
                return blurred_step(x + dot_mm / 2, sigma) - blurred_step(x - dot_mm / 2, sigma);
            };
            sum += g.weight * (share(place.x) * share(place.y));
        }
        return sum;
    };
    result.level = light_at({0, 0});
    result.truth = [=](const scene::Camera& camera, double x_px, double y_px) -> std::optional<glm::dvec3> {
        const auto place = place_on_plane(camera, 0, x_px, y_px);
        return place && glm::length(*place) < around_dot_mm ? std::optional(light_at(*place)) : std::nullopt;
    };
    return result;
}

ClosedForm lit_sphere(const Profile& profile) {
    constexpr int columns = 256, rows = 128;
    constexpr float radius_mm = 40;
    scene::Mesh mesh;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            const double u = static_cast<double>(i) / columns;
            const double v = static_cast<double>(j) / rows;
            const glm::vec3 outwards(-std::sin(2 * pi * u) * std::sin(pi * v), std::cos(pi * v),
                                     -std::cos(2 * pi * u) * std::sin(pi * v)); // the seam is behind
            // Every normal points up, so that ambient light, which comes from above, is the same everywhere.
            mesh.vertices.push_back({radius_mm * outwards,
                                     {0, 1, 0},
                                     {1, 0, 0, 1},
                                     {static_cast<float>(u), static_cast<float>(v)}});
        }
    }
    const auto index = [](int i, int j) { return static_cast<std::uint32_t>(j * (columns + 1) + i); };
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            mesh.indices.insert(mesh.indices.end(), {index(i, j), index(i, j + 1), index(i + 1, j + 1),
                                                     index(i, j), index(i + 1, j + 1), index(i + 1, j)});
        }
    }
    mesh.has_uv = true;
    ClosedForm result;
    result.name = "lit sphere";
    result.model.name = "sphere";
    result.model.materials.emplace_back();
    result.model.meshes.push_back(std::move(mesh));
    result.look = diffuse_look(profile);
    result.light.ambient_irradiance = glm::vec3(static_cast<float>(pi));
    result.truth = [](const scene::Camera&, double, double) { return std::optional(glm::dvec3(1)); };
    return result;
}

ClosedForm lit_plane(const Profile& profile) {
    ClosedForm result;
    result.name = "lit plane";
    result.model = plane(0, [](int, int) { return true; });
    result.look = diffuse_look(profile);
    result.light = frontal_light(0);
    result.truth = [](const scene::Camera& camera, double x_px, double y_px) {
        return place_on_plane(camera, 0, x_px, y_px) ? std::optional(glm::dvec3(1)) : std::nullopt;
    };
    return result;
}

std::vector<ClosedForm> closed_forms(const Profile& profile) {
    return {half_lit_plane(profile, 0), half_lit_plane(profile, 30), half_lit_plane(profile, 60),
            lit_dot(profile),           lit_sphere(profile),         lit_plane(profile)};
}

scene::Camera frontal_camera(double distance_mm, double fov_deg, int width, int height) {
    return {{0, 0, static_cast<float>(distance_mm)},
            {0, 0, 0},
            static_cast<float>(glm::radians(fov_deg)),
            width,
            height};
}

namespace {

/// The truth's mean over a pixel, which is what a camera sees; nothing where a part of it is not asked for.
std::optional<glm::dvec3> mean_truth(const ClosedForm& scene, const scene::Camera& camera, int x, int y) {
    constexpr int side = 4; // light varies over no less than the narrowest Gaussian's width
    glm::dvec3 sum(0);
    for (int i = 0; i < side * side; ++i) {
        const auto truth = scene.truth(camera, x + (i % side + 0.5) / side, y + (i / side + 0.5) / side);
        if (!truth) {
            return std::nullopt;
        }
        sum += *truth;
    }
    return sum / static_cast<double>(side * side);
}

} // namespace

double closed_form_error(const ClosedForm& scene, const scene::Camera& camera, const scene::Frame& frame) {
    double sum = 0;
    std::size_t count = 0;
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x) {
            const auto at = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                                 static_cast<std::size_t>(x));
            const auto truth = frame.linear[at + 3] == 1 ? mean_truth(scene, camera, x, y) : std::nullopt;
            if (truth) {
                const glm::dvec3 value(frame.linear[at], frame.linear[at + 1], frame.linear[at + 2]);
                const glm::dvec3 error = (value - *truth) / scene.level;
                sum += glm::dot(error, error) / 3;
                ++count;
            }
        }
    }
    if (count == 0) {
        throw support::failure("{}: expected pixels that show it, found none", scene.name);
    }
    return std::sqrt(sum / static_cast<double>(count));
}

} // namespace measure
