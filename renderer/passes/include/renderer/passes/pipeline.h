// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include <renderer/optics/profile.h>
#include <renderer/scene/camera.h>
#include <renderer/scene/model.h>

namespace renderer::passes {

/// How subsurface scattering is simulated.
enum class Shader { no_sss, ts, ss_jittered, ss_full };

/// The stable name of a shader, and back; nothing for an unknown name.
std::string_view shader_name(Shader shader);
std::optional<Shader> shader_of(std::string_view name);

/// A light so far away that its rays are parallel.
struct Light {
    glm::vec3 direction{0, 0, 1};    ///< unit vector towards the light
    glm::vec3 irradiance{0};         ///< of a surface that faces it, linear Rec. 709
    glm::vec3 ambient_irradiance{0}; ///< from above, of a surface that faces up; none from below
    int shadow_map_size = 512;       ///< texels a side
    float shadow_softness_mm = 1;    ///< standard deviation of the filter at the shadow's edge

    bool operator==(const Light&) const = default;
};

/// All that is the same for the four shaders, so that only the method of scattering differs.
struct Look {
    optics::Profile profile;
    float texture_mix = 0.5f; ///< exponent of the albedo before scattering; 1 minus it is left for after
    float specular_intensity = 0.18f; ///< rho_s
    float fresnel_f0 = 0.028f;
    float roughness = 0.3f;   ///< Beckmann slope where the model has none
    float bloom_strength = 0; ///< share of the light that the lens spreads, 0 to 1
    float bloom_sigma_px = 8; ///< standard deviation
    float exposure = 1;
    glm::vec3 background{0}; ///< linear Rec. 709
    int samples = 4;         ///< MSAA samples a pixel
};

/// Kernel widths on the screen [Jimenez2009, Eqs. 2-3].
struct Stretch {
    std::optional<float> alpha; ///< published value; else the physical width
    std::optional<float> beta;  ///< published value, pixels; else the physical value
};

/// What is peculiar to each method.
struct Methods {
    int ts_map_size = 1024;         ///< texels of the irradiance map's side
    bool ts_unblurred_first = true; ///< lighting of the final pass stands for the narrowest Gaussian
    float jitter_unit_mm = 0.527f;  ///< length of one unit of Hable's kernel
    Stretch jitter_stretch, full_stretch;
};

/// A finished image, rows from the top down.
struct Frame {
    int width = 0, height = 0;
    std::vector<std::uint8_t> srgb; ///< RGB, 8 bits, as participants see it
    std::vector<float> linear; ///< RGBA, linear Rec. 709, exposed, before encoding; A is the head's coverage
    std::vector<std::string> passes_run;    ///< nodes computed for this frame
    std::vector<std::string> passes_reused; ///< nodes whose results an earlier frame had left
};

/// Seconds spent in each kind of node since the pipeline was made, and how often it ran.
struct NodeCost {
    double seconds = 0;
    int runs = 0;
};
using Costs = std::map<std::string, NodeCost>;

/// SHA-256 of the texts of all shader files: changes when the pictures may.
std::string shader_code_digest();

/// Renders one model, which outlives it, from many views under many lights. Shadow map and irradiance maps
/// are kept while the light stays the same, the lit frame while light and camera do: ask for images light by
/// light, camera by camera. Needs a current OpenGL 4.5 context for as long as it lives; not for use from
/// several threads.
class Pipeline {
public:
    /// Throws support::InputError if the look or the methods ask for more than the driver allows,
    /// support::Failure if it lacks the memory.
    Pipeline(const scene::Model& model, const Look& look, const Methods& methods);
    ~Pipeline();
    Pipeline(const Pipeline&) = delete;
    Pipeline& operator=(const Pipeline&) = delete;

    /// Make what render() will need. Throws support::InputError for sizes that the driver does not allow and,
    /// if the shader is `ts`, for a model without usable texture coordinates: then nothing has been rendered.
    void prepare(Shader shader, const scene::Camera& camera, const Light& light);

    /// Errors as prepare().
    Frame render(Shader shader, const scene::Camera& camera, const Light& light, bool with_linear = false);

    const Costs& costs() const;
    /// Things about the model that a user should know, such as texture coordinates that overlap; filled by
    /// render().
    const std::vector<std::string>& warnings() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Millimetres per unit of the depth in which alpha = 11 is the physical kernel width of the 2009 stimuli
/// (988 lines, 20 degrees): (988 / 2) cot(10 degrees) / 11. The paper states no unit.
constexpr float published_depth_unit_mm = 254.69f;

} // namespace renderer::passes
