// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <set>
#include <string>
#include <vector>

#include <study/protocol.h>

namespace stimuli {

/// One image of a stimulus set.
struct Item {
    std::string shader;
    study::Distance distance;
    int azimuth_deg = 0;

    /// The stem of its files.
    std::string name() const { return study::stimulus_name(shader, distance.name, azimuth_deg); }
};

/// The ground truth, which can be asked for though a protocol does not list it.
constexpr const char* reference_shader = "reference";

/// All images of a protocol, ordered so that what shares a light, then a camera, stands together.
std::vector<Item> design(const study::Protocol& protocol);

/// Which images to keep: values of shader, distance and azimuth, an empty list keeping all; and which part of
/// them.
struct Selection {
    std::vector<std::string> shaders, distances;
    std::vector<int> azimuths_deg;
    int shard = 1, shards = 1; ///< part `shard` (from 1) of `shards` parts
};

/// From "--only KEY=V[,V...]" arguments and a "--shard I/N" argument (empty: all).
/// Throws support::InputError for a key or value that the protocol does not have; it need not have the
/// reference.
Selection selection(const std::vector<std::string>& only, const std::string& shard,
                    const study::Protocol& protocol);

/// The names of the images to keep. Parts are runs of the images in the order of design(), so that they
/// differ by one image at most, and images of one light, then of one view, stay together as far as that
/// allows. It depends on nothing but the arguments: parts of one set are disjoint, and together are the set.
std::set<std::string> selected(const Selection& selection, const study::Protocol& protocol);

} // namespace stimuli
