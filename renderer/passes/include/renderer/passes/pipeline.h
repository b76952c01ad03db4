// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <renderer/scene/appearance.h>
#include <renderer/scene/camera.h>
#include <renderer/scene/frame.h>
#include <renderer/scene/model.h>

namespace renderer::passes {

/// How subsurface scattering is simulated.
enum class Shader { no_sss, ts, ss_jittered, ss_full };

/// The stable name of a shader, and back; nothing for an unknown name.
std::string_view shader_name(Shader shader);
std::optional<Shader> shader_of(std::string_view name);

using scene::Frame;
using scene::Light;
using scene::Look;

/// Kernel widths on the screen [Jimenez2009, Eqs. 2-3].
struct Stretch {
    std::optional<float> alpha; ///< published value; else the physical width
    std::optional<float> beta;  ///< published value, pixels; else the physical value
    bool operator==(const Stretch&) const = default;
};

/// Irradiance in texture space [DEonLuebke2007].
struct TextureSpaceMethod {
    int map_size = 1024; ///< texels of the irradiance map's side
    /// The published form: the lighting of the final pass stands for the narrowest Gaussian. Else it is that
    /// lighting, blurred on the screen.
    bool unblurred_first = false;
    /// Maps are lit where the camera sees them or light reaches what it sees, within 2/255; and their sides,
    /// halved down to an eighth of map_size, follow the size on the screen [JimenezGutierrez2008], within
    /// 1/255 RMS. Else maps are whole, and lit once a light.
    bool culled = false;
};

/// How the Gaussians' weighted sum is made.
enum class Accumulation {
    on_the_fly,   ///< blended as each is done: three targets [JimenezGutierrez2010, section 7.3.3]
    weighted_sum, ///< all kept, then summed in a pass of its own: a target each [Jimenez2009]
};

/// How a surface that is tilted away from the camera shortens kernels on the screen.
enum class Foreshortening {
    published, ///< 1 / (1 + |tan|) along x and along y [Jimenez2009, Eqs. 2-3]
    exact,     ///< by the surface's metric: right for planes of any tilt, in perspective
};

/// One pass over the screen with few taps, turned at random in each pixel.
struct JitteredMethod {
    int taps = 13;          ///< 13: Hable's kernel; 25 or 49: taps that follow the profile
    float unit_mm = 0.527f; ///< length of one unit of Hable's kernel
    Foreshortening foreshortening = Foreshortening::exact;
    Stretch stretch;
};

/// Gaussians on the screen [Jimenez2009, JimenezGutierrez2010].
struct FullMethod {
    int taps = 7; ///< of each 1D Gaussian: odd, 7 to 25, over three standard deviations to both sides
    /// The published seven weights at whole standard deviations, whose variance is 1.08 times too large; else
    /// weights and places that give each Gaussian its variance, narrower than a pixel or not.
    bool published_taps = false;
    Foreshortening foreshortening = Foreshortening::exact;
    bool reject_gaps = true;     ///< weigh taps by their distance in depth from the surface's plane, too
    int target_bits = 0;         ///< 8, 16 or 32 a channel; 0: 16, or 32 where the driver is a CPU
    bool half_resolution = true; ///< wide Gaussians at half the resolution
    Accumulation accumulation = Accumulation::on_the_fly;
    /// The unblurred light stands for the narrowest Gaussian, as the 2010 article has it for its fit of four.
    bool unblurred_first = false;
    Stretch stretch; ///< published foreshortening alone reads beta
    bool operator==(const FullMethod&) const = default;
};

/// The form of the 2009 and 2010 papers.
constexpr FullMethod published_full() {
    FullMethod method;
    method.published_taps = true;
    method.foreshortening = Foreshortening::published;
    method.reject_gaps = false;
    method.half_resolution = false;
    return method;
}

/// What is peculiar to each method.
struct Methods {
    TextureSpaceMethod ts;
    JitteredMethod jittered;
    FullMethod full;
};

/// What is shared and what is skipped. Each is on unless it is to be measured.
struct Switches {
    bool share = true;         ///< nodes are kept from frame to frame; else each frame computes all it needs
    bool cull = true;          ///< parts of meshes that are out of view or turned away are not drawn
    bool front_to_back = true; ///< the nearest mesh is drawn first
    bool specialise = true;    ///< programs without what a material or look has none of
    bool skip_unlit = true;    ///< no shadow map for a light that lights nothing in view
    bool rectangle = true;     ///< nothing runs outside of the pixels that can show the model
    bool early_test = true;    ///< a depth test keeps blurs off other pixels; else a branch in the shader
    bool level_of_detail = true; ///< Gaussians too narrow to be seen are left out, pixel by pixel
};

/// A switch by name. Without it frames are the same to `bound`, RMS of the 8-bit levels; 0: bit for bit.
struct SwitchEntry {
    std::string_view name;
    bool Switches::*member;
    double bound = 0;
};
constexpr SwitchEntry switch_list[]{{"share", &Switches::share},
                                    {"cull", &Switches::cull},
                                    {"front_to_back", &Switches::front_to_back},
                                    {"specialise", &Switches::specialise},
                                    {"skip_unlit", &Switches::skip_unlit},
                                    {"rectangle", &Switches::rectangle},
                                    {"early_test", &Switches::early_test},
                                    {"level_of_detail", &Switches::level_of_detail, 1}};
static_assert(sizeof(Switches) == std::size(switch_list) * sizeof(bool), "a switch lacks its line");

/// Seconds spent in each kind of node since the pipeline was made, and how often it ran.
struct NodeCost {
    double seconds = 0;
    int runs = 0;
};
using Costs = std::map<std::string, NodeCost>;

/// SHA-256 of the passes, their shaders, and what they build on: changes when the pictures may.
std::string shader_code_digest();

/// Renders one model, which outlives it, from many views under many lights. Shadow map and irradiance maps
/// are kept while the light stays the same, the lit frame while light and camera do: ask for images light by
/// light, camera by camera. Needs a current OpenGL 4.5 context for as long as it lives; not for use from
/// several threads.
class Pipeline {
public:
    /// Throws support::InputError if the look or the methods ask for more than the driver allows,
    /// support::Failure if it lacks the memory.
    Pipeline(const scene::Model& model, const Look& look, const Methods& methods,
             const Switches& switches = {});
    ~Pipeline();
    Pipeline(const Pipeline&) = delete;
    Pipeline& operator=(const Pipeline&) = delete;

    /// Make what render() will need. Throws support::InputError for sizes that the driver does not allow and,
    /// if the shader is `ts`, for a model without usable texture coordinates: then nothing has been rendered.
    void prepare(Shader shader, const scene::Camera& camera, const Light& light);

    /// Draw a frame and leave it on the device. Errors as prepare().
    void draw(Shader shader, const scene::Camera& camera, const Light& light, bool with_linear = false);
    /// The frame that was drawn last. `with_linear` as it was drawn.
    Frame read(bool with_linear = false);
    /// Both.
    Frame render(Shader shader, const scene::Camera& camera, const Light& light, bool with_linear = false);

    /// Whether to wait for the end of each node, so that costs() tells what each took; so it is at first.
    void time_nodes(bool wanted);
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
