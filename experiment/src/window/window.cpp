// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "window.h"

#include <algorithm>
#include <cctype>

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <renderer/gl/context.h>
#include <support/error.h>

#include "../interruption.h"
#include "pacing.h"

namespace experiment {
namespace {

Window* monitored = nullptr; // GLFW tells of monitors without saying whose they are

std::optional<Key> key_of(int glfw_key) {
    switch (glfw_key) {
    case GLFW_KEY_SPACE:
        return Key::space;
    case GLFW_KEY_1:
    case GLFW_KEY_KP_1:
        return Key::one;
    case GLFW_KEY_2:
    case GLFW_KEY_KP_2:
        return Key::two;
    default:
        return std::nullopt;
    }
}

void set_hints() {
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_FALSE); // bytes are shown as they are
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_ALPHA_BITS, 0);
    glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
    glfwWindowHint(GLFW_DECORATED, GLFW_FALSE);
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
}

Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

} // namespace

Window::Window(int width, int height, const ScreenOptions& options, const study::KeyChord& leave)
    : monitor_(monitor_of(options.monitor)), leave_(leave) {
    open(width, height, options);
}

void Window::open(int width, int height, const ScreenOptions& options) {
    // Make sure that the monitor can show a stimulus whole.
    const GLFWvidmode* mode = glfwGetVideoMode(monitor_);
    if (!mode) {
        throw support::failure("a session needs a monitor (or --simulate): {}", glfw_reason());
    }
    check_size("monitor", width, height, mode->width, mode->height);

    // Open the window with its context.
    set_hints();
    glfwWindowHint(GLFW_REFRESH_RATE, mode->refreshRate > 0 ? mode->refreshRate : GLFW_DONT_CARE);
    window_ = options.windowed ? glfwCreateWindow(width, height, "skin2afc", nullptr, nullptr)
                               : glfwCreateWindow(mode->width, mode->height, "skin2afc", monitor_, nullptr);
    if (!window_) {
        throw support::failure("a window with OpenGL 4.5 core through EGL is needed: {}", glfw_reason());
    }
    glfwMakeContextCurrent(window_);
    renderer::gl::require_opengl_45();
    glDisable(GL_FRAMEBUFFER_SRGB);
    glDisable(GL_DITHER);
    glfwSwapInterval(1);
    const auto [framebuffer_width, framebuffer_height] = framebuffer_size();
    check_size("window's framebuffer", width, height, framebuffer_width, framebuffer_height);
    listen();
}

/// Listen to the keyboard, and to what may spoil a trial.
void Window::listen() {
    hide_pointer();
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int scancode, int action, int modifiers) {
        of(window).on_key(key, scancode, action, modifiers);
    });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) { of(window).damaged_ = true; });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* window, int, int) { of(window).changed_ = true; });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* window, int focused) {
        of(window).notes_.push_back({monotonic_s(), focused == GLFW_TRUE ? "the window has the keyboard again"
                                                                         : "the window lost the keyboard"});
    });
    listen_to_monitors();
}

void Window::listen_to_monitors() {
    monitored = this;
    glfwSetMonitorCallback([](GLFWmonitor*, int event) {
        monitored->changed_ = true;
        monitored->notes_.push_back({monotonic_s(), event == GLFW_DISCONNECTED ? "a monitor was unplugged"
                                                                               : "a monitor was plugged in"});
    });
}

Window::~Window() {
    glfwSetMonitorCallback(nullptr);
    monitored = nullptr;
    if (window_) {
        glfwDestroyWindow(window_);
    }
}

void Window::hide_pointer() const { glfwSetInputMode(window_, GLFW_CURSOR, GLFW_CURSOR_HIDDEN); }

std::array<int, 2> Window::framebuffer_size() const {
    std::array<int, 2> size{};
    glfwGetFramebufferSize(window_, &size[0], &size[1]);
    return size;
}

int Window::reported_hz() const {
    // The monitor may have been unplugged, and GLFW has forgotten it.
    int count = 0;
    GLFWmonitor** const monitors = glfwGetMonitors(&count);
    const bool there = std::find(monitors, monitors + count, monitor_) != monitors + count;
    const GLFWvidmode* mode = there ? glfwGetVideoMode(monitor_) : nullptr;
    return mode ? mode->refreshRate : 0;
}

void Window::swap() {
    glfwSwapBuffers(window_);
    glFinish();
    framebuffer_size(); // a question to the server, which it answers after what was asked before
}

void Window::wait_for_back_buffer() {
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
    glFinish();
}

/// Whether these are the experimenter's keys, by the letter that is printed on the key; where that is none of
/// the Latin alphabet and no digit (Cyrillic; the digits' row of AZERTY), by the key's place.
bool Window::ends_session(int key, int scancode, int modifiers) const {
    const char* name = glfwGetKeyName(key, scancode);
    const auto latin = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
    // GLFW numbers keys by the ASCII capital or digit that a US keyboard has there.
    const int printed = name && latin(name[0]) && name[1] == '\0' ? name[0] : key;
    const auto holds = [&](int modifier) { return (modifiers & modifier) != 0; };
    return printed >= 0 && printed < 128 && std::tolower(printed) == leave_.key &&
           holds(GLFW_MOD_CONTROL) == leave_.ctrl && holds(GLFW_MOD_SHIFT) == leave_.shift &&
           holds(GLFW_MOD_ALT) == leave_.alt;
}

void Window::on_key(int key, int scancode, int action, int modifiers) {
    if (action == GLFW_PRESS) {
        keys_.push_back(key);
        leaving_ = leaving_ || ends_session(key, scancode, modifiers);
    }
    const auto meaning = key_of(key);
    if (!meaning) {
        return;
    }
    if (action == GLFW_RELEASE) {
        gate_.release(key);
    } else if (gate_.press(key)) {
        presses_.push_back({*meaning, monotonic_s()});
    }
}

void Window::poll() {
    glfwPollEvents();
    Interruption::check();
    if (std::exchange(leaving_, false)) {
        throw Interrupted(fmt::format("the experimenter ended the session ({})", study::text_of(leave_)));
    }
}

void Window::clear_presses() {
    presses_.clear();
    keys_.clear();
}

std::optional<Press> Window::pressed(std::initializer_list<Key> keys) const {
    const auto wanted = [&](const Press& press) {
        return std::find(keys.begin(), keys.end(), press.key) != keys.end();
    };
    const auto press = std::find_if(presses_.begin(), presses_.end(), wanted);
    return press == presses_.end() ? std::nullopt : std::optional(*press);
}

bool Window::take_close() {
    const bool asked = glfwWindowShouldClose(window_) == GLFW_TRUE;
    glfwSetWindowShouldClose(window_, GLFW_FALSE);
    return asked;
}

} // namespace experiment
