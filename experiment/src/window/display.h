// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <study/protocol.h>

#include "../session.h"
#include "../stage.h"

struct GLFWmonitor;

namespace experiment {

/// GLFW, while it lives. Throws support::Failure without a display.
class Glfw {
public:
    Glfw();
    ~Glfw();
    Glfw(const Glfw&) = delete;
    Glfw& operator=(const Glfw&) = delete;
};

/// What GLFW has to say of its last error.
std::string glfw_reason();

/// A monitor by its number, from 1, the primary one. Throws support::InputError where there are not so many,
/// support::Failure where there is none.
GLFWmonitor* monitor_of(int number);

/// A monitor's width and height, px; throws as monitor_of.
std::array<int, 2> resolution_of(int number);

/// Refuse a surface that cannot show a picture whole. Throws support::InputError.
void check_size(const std::string& what, int width, int height, int found_width, int found_height);

/// The width of an angle of view: what an object of that width fills from that distance, both in mm; degrees.
double visual_angle_deg(double width_mm, double distance_mm);

/// Fill in what is known of the screen without a window, and what may spoil a session there.
void describe_screen(GLFWmonitor* monitor, const study::Protocol& protocol, const ScreenOptions& options,
                     StageFacts& facts);

/// Check that a session could be shown, without showing anything; what is known of the screen. Throws
/// support::InputError for a screen too small, or a text too long for a page; support::Failure without a
/// display.
StageFacts look_at_display(const study::Protocol& protocol, std::size_t trials, const ScreenOptions& options);

} // namespace experiment
