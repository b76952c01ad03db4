// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <study/session.h>

namespace study {

namespace fs = std::filesystem;
using Rgb = std::array<double, 3>;

/// The picture every stimulus shares.
struct ImageSettings {
    int width = 1650, height = 988; ///< pixels
    int samples = 4;                ///< MSAA samples per pixel
    Rgb background{0, 0, 0};        ///< linear Rec. 709
    double exposure = 1;            ///< factor on linear light before the output transform
};

/// One camera distance with the name it has in file names and logs.
struct Distance {
    std::string name;
    double units = 0; ///< in head units, see CameraSettings
};

struct CameraSettings {
    double fov_deg = 20;    ///< vertical
    double head_units = 27; ///< the head's height in distance units
    std::vector<Distance> distances;
};

/// A light beside the one whose azimuth is studied; it does not turn with it.
struct FurtherLight {
    double azimuth_deg = 0, elevation_deg = 45;
    Rgb irradiance{}; ///< of a surface facing the light, linear Rec. 709
};

struct LightSettings {
    double elevation_deg = 45;
    std::vector<int> azimuths_deg; ///< 0 in front of the face, turning about +Y; 0 ... 359
    Rgb irradiance{};              ///< of a surface facing the light, linear Rec. 709
    Rgb ambient{};                 ///< irradiance from the upper hemisphere, linear Rec. 709
    int shadow_map_size = 4096;    ///< texels
    double shadow_softness_mm = 0; ///< standard deviation of the shadow filter
    std::vector<FurtherLight> further;
};

struct SkinSettings {
    std::string profile;           ///< name of a sum of Gaussians
    double texture_mix = 0.5;      ///< share of the albedo applied before scattering, as an exponent
    double specular_intensity = 0; ///< rho_s of Kelemen/Szirmay-Kalos
    double fresnel_f0 = 0;         ///< Schlick's reflectance at normal incidence
    double roughness = 0.3;        ///< Beckmann slope m where the model has no roughness
};

struct BloomSettings {
    double strength = 0; ///< share of the light that the lens spreads
    double sigma_px = 0; ///< standard deviation, pixels of the stimulus
};

struct LensSettings {
    double aperture_mm = 0; ///< diameter; 0: a pinhole, all is sharp
    double focus_mm = 0;    ///< distance that is sharp; 0: where the camera looks
};

struct TextureSpaceSettings {
    int map_size = 1024;          ///< texels of the irradiance map's side
    bool unblurred_first = false; ///< the lighting of the final pass stands for the narrowest Gaussian
    bool culled = false;          ///< light only what is in view, in maps as large as the screen asks for
};

/// Kernel widths on the screen [Jimenez2009, Eqs. 2-3]: physical, from millimetres, unless published values
/// are set.
struct StretchSettings {
    std::optional<double> alpha; ///< 11 is the physical width for the stimuli of 2009
    std::optional<double> beta;  ///< pixels
};

struct JitteredSettings {
    int taps = 13;
    double unit_mm = 0; ///< length of one unit of Hable's kernel
    bool exact_foreshortening = true;
    StretchSettings stretch;
};

struct FullSettings {
    int taps = 7;
    bool published_taps = false;
    bool exact_foreshortening = true;
    bool reject_gaps = true;
    int target_bits = 0; ///< 8, 16, 32; 0: what suits the driver
    bool half_resolution = true;
    bool weighted_sum = false;    ///< each Gaussian in a target of its own
    bool unblurred_first = false; ///< the unblurred light stands for the narrowest Gaussian
    StretchSettings stretch;
};

/// The ground truth on the CPU.
struct ReferenceSettings {
    int samples_per_side = 4;     ///< rays a pixel: the square of this
    double cells_per_sigma = 1.2; ///< surface cells per standard deviation of a Gaussian
    std::string profile; ///< empty: the skin's; else a profile of the skin's kind, dipole_<medium> or burley
    Rgb burley_albedo{}, burley_mean_free_path_mm{};
};

/// What a model file does not tell by itself; paths are relative to the model's folder.
struct ModelSettings {
    std::optional<fs::path> file; ///< relative to the protocol's folder
    std::optional<fs::path> base_color, normal, roughness;
    double metres_per_unit = 1;
    bool flip_v = false;
    double longest_edge_mm = 3; ///< the mesh is rounded off until its mean edge is no longer than this
    double head_height_mm = 232;
    std::optional<std::array<double, 3>> head_centre_mm; ///< else the middle of the top head_height_mm
    std::vector<std::string> not_skin;                   ///< names of materials that light does not enter
};

/// Where a copy of the model stands: turned about the vertical through the origin, then moved.
struct Placement {
    std::array<double, 3> place_mm{};
    double turn_deg = 0;
};

/// A grey plane that faces the camera, centred before the head.
struct ScreenSettings {
    double z_mm = 0, width_mm = 0, height_mm = 0;
};

/// What stands before the camera.
struct SceneSettings {
    std::vector<Placement> heads; ///< empty: the model as it is
    std::optional<ScreenSettings> screen;
};

/// The screen that participants see, and from where.
struct DisplaySettings {
    double width_mm = 0, width_px = 0; ///< of the whole screen
    double distance_mm = 0;            ///< from the eyes to the screen
};

/// A study as its protocol file describes it. protocols/FORMAT.md documents every field.
struct Protocol {
    fs::path file;
    std::string digest; ///< SHA-256 of the file
    std::string name, title;
    std::vector<std::string> shaders; ///< in the order of the contact sheet
    ImageSettings image;
    CameraSettings camera;
    LightSettings light;
    SkinSettings skin;
    BloomSettings bloom;
    LensSettings lens;
    TextureSpaceSettings ts;
    JitteredSettings ss_jittered;
    FullSettings ss_full;
    ReferenceSettings reference;
    ModelSettings model;
    SceneSettings scene;
    SessionSettings session;
    std::optional<DisplaySettings> display;
};

/// Read and check a protocol file. Throws support::InputError that names file, line, field, expectation,
/// finding.
Protocol read_protocol(const fs::path& file);

/// "<shader>_<distance>_<azimuth, 3 digits>", the stem of a stimulus's files.
std::string stimulus_name(const std::string& shader, const std::string& distance, int azimuth_deg);

} // namespace study
