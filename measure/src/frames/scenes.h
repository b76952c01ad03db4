// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

#include <renderer/passes/pipeline.h>
#include <renderer/scene/model.h>
#include <stimuli/head.h>
#include <study/protocol.h>

#include "published.h"

namespace measure {

/// How large a head is in the picture.
enum class HeadDistance {
    near,   ///< as high as the picture
    medium, ///< a third of the height
    far     ///< a twelfth
};
/// The share of the picture's height that a head fills.
double height_share(HeadDistance distance);
std::string_view distance_name(HeadDistance distance);

/// One scene, timed for every place in the tables that it stands at.
struct FrameScene {
    std::vector<FramePlace> places;
    int heads = 1, lights = 2;
    HeadDistance distance = HeadDistance::medium;
    int samples = 1;
    std::string profile = "skin_4g_jimenez2010";
    int shadow_map_size = 512;                ///< as both papers have it
    bool hidden = false;                      ///< a screen stands before the heads
    bool outside = false;                     ///< the camera looks past the heads
    bool busts = false;                       ///< of marble
    bool effects = false;                     ///< with depth of field, and each node timed by itself
    std::optional<stimuli::HeadDetail> level; ///< of the built-in head
    int block = 0;                            ///< scenes of one block are timed in the same rounds

    /// The same for scenes that show copies of the same model to the same pipelines.
    std::string model_key() const;
    std::string rig_key() const;
    std::string name() const;
};

/// All scenes, block by block. `quick`: fewer; `levels`: with those of the built-in head's levels.
std::vector<FrameScene> frame_scenes(int highest_samples, bool quick, bool levels);

/// A way to render a scene.
struct FrameSetting {
    renderer::passes::Shader shader = renderer::passes::Shader::no_sss;
    std::string name; ///< what is special about it
    renderer::passes::Methods methods;
    renderer::passes::Switches switches;
    bool time_nodes = false; ///< one by one
};
/// What a scene is rendered by. The setting that others are compared with has the name `faithful`.
std::vector<FrameSetting> frame_settings(const FrameScene& scene, const study::Protocol& protocol);
inline constexpr std::string_view faithful = "faithful", culled = "culled";

/// Of one copy of the model.
struct ModelFacts {
    renderer::scene::Bounds bounds;
    std::array<double, 3> head_centre_mm{};
};

/// Places side by side in as few rows as show all of them in a view that is so wide, each row behind the one
/// before it, symmetrical about the origin.
std::vector<study::Placement> side_by_side(int count, double width_mm, double depth_mm, double view_width_mm);

/// The protocol of a scene: `base`, with the scene's heads, lights, distance and image.
study::Protocol protocol_of(const FrameScene& scene, const study::Protocol& base, const ModelFacts& facts);

} // namespace measure
