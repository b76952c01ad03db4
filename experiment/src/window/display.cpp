// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "display.h"

#include <cmath>
#include <cstdlib>
#include <numbers>

#include <fmt/format.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <support/error.h>

#include "texts.h"

namespace experiment {
namespace {

constexpr double mm_per_cm = 10;

/// How large the screen is, and from where it is seen: what the command line says, else the protocol, else
/// the monitor itself.
void measure_screen(GLFWmonitor* monitor, const GLFWvidmode& mode, const study::Protocol& protocol,
                    const ScreenOptions& options, StageFacts& facts) {
    int width_mm = 0;
    int height_mm = 0;
    glfwGetMonitorPhysicalSize(monitor, &width_mm, &height_mm);
    double screen_mm = width_mm;
    if (options.screen_width_mm) {
        screen_mm = *options.screen_width_mm;
    } else if (protocol.display) {
        screen_mm = protocol.display->width_mm;
    } else {
        facts.warnings.push_back(
            width_mm > 0 ? fmt::format("the screen itself says that it is {} mm wide; measure it, and give "
                                       "--screen-width-mm",
                                       width_mm)
                         : std::string("the screen's size is unknown; measure its width, and give "
                                       "--screen-width-mm"));
    }
    if (options.distance_cm) {
        facts.viewing_distance_mm = *options.distance_cm * mm_per_cm;
    } else if (protocol.display) {
        facts.viewing_distance_mm = protocol.display->distance_mm;
    } else {
        facts.warnings.push_back("the distance of the eyes from the screen is unknown; give --distance-cm");
    }
    if (screen_mm > 0) {
        const double mm_per_px = screen_mm / mode.width;
        facts.screen_size_mm = {screen_mm, mm_per_px * mode.height};
        if (facts.viewing_distance_mm) {
            facts.stimulus_width_deg =
                visual_angle_deg(protocol.image.width * mm_per_px, *facts.viewing_distance_mm);
        }
    }
}

bool is_set(const char* name) {
    const char* value = std::getenv(name);
    return value && *value != '\0';
}

} // namespace

Glfw::Glfw() {
    if (glfwInit() == GLFW_FALSE) {
        throw support::failure("a session needs a display (or --simulate): {}", glfw_reason());
    }
}

Glfw::~Glfw() { glfwTerminate(); }

std::string glfw_reason() {
    const char* text = nullptr;
    return glfwGetError(&text) != GLFW_NO_ERROR && text ? text : "no reason given";
}

GLFWmonitor* monitor_of(int number) {
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    if (count == 0) {
        throw support::failure("a session needs a monitor (or --simulate): {}", glfw_reason());
    }
    if (number < 1 || number > count) {
        throw support::input_error("--monitor: expected 1 to {}, the monitors there are, found {}", count,
                                   number);
    }
    return monitors[number - 1];
}

std::array<int, 2> resolution_of(int number) {
    const GLFWvidmode* mode = glfwGetVideoMode(monitor_of(number));
    if (!mode) {
        throw support::failure("a session needs a monitor (or --simulate): {}", glfw_reason());
    }
    return {mode->width, mode->height};
}

void check_size(const std::string& what, int width, int height, int found_width, int found_height) {
    if (found_width < width || found_height < height) {
        throw support::input_error("{}: expected at least the stimulus's {}x{} pixels, found {}x{}", what,
                                   width, height, found_width, found_height);
    }
}

double visual_angle_deg(double width_mm, double distance_mm) {
    return 2 * std::atan(width_mm / 2 / distance_mm) * 180 / std::numbers::pi;
}

void describe_screen(GLFWmonitor* monitor, const study::Protocol& protocol, const ScreenOptions& options,
                     StageFacts& facts) {
    const GLFWvidmode* mode = glfwGetVideoMode(monitor);
    if (!mode) {
        throw support::failure("a session needs a monitor (or --simulate): {}", glfw_reason());
    }
    check_size("monitor", protocol.image.width, protocol.image.height, mode->width, mode->height);
    facts.monitor = fmt::format("{} ({}), {} x {} pixels, reports {} Hz", options.monitor,
                                glfwGetMonitorName(monitor), mode->width, mode->height, mode->refreshRate);
    facts.resolution_px = {mode->width, mode->height};
    measure_screen(monitor, *mode, protocol, options, facts);
    const bool fills = mode->width == protocol.image.width && mode->height == protocol.image.height;
    if (!fills && !options.windowed) {
        facts.warnings.push_back(
            fmt::format("the monitor has {}x{} pixels, the pictures {}x{}: black will be "
                        "around them",
                        mode->width, mode->height, protocol.image.width, protocol.image.height));
    }
    float scale_x = 1;
    float scale_y = 1;
    glfwGetMonitorContentScale(monitor, &scale_x, &scale_y);
    if (scale_x != 1 || scale_y != 1) {
        facts.warnings.push_back(
            fmt::format("the desktop scales by {:.2f}; make sure that it does not scale this "
                        "window, too",
                        scale_x));
    }
    const char* session = std::getenv("XDG_SESSION_TYPE");
    if (is_set("WAYLAND_DISPLAY") || (session && std::string_view(session) == "wayland")) {
        facts.warnings.push_back(
            "the desktop runs Wayland, which delays pictures; log in with X11 for exact times");
    }
    if (options.windowed) {
        facts.warnings.push_back(
            "a window, not the full screen: the desktop may show through and delay pictures");
    }
}

StageFacts look_at_display(const study::Protocol& protocol, std::size_t trials,
                           const ScreenOptions& options) {
    const Glfw glfw;
    GLFWmonitor* monitor = monitor_of(options.monitor);
    StageFacts facts;
    describe_screen(monitor, protocol, options, facts);
    const GLFWvidmode* mode = glfwGetVideoMode(monitor);
    check_texts(protocol, trials,
                options.windowed ? std::array{protocol.image.width, protocol.image.height}
                                 : std::array{mode->width, mode->height});
    return facts;
}

} // namespace experiment
