// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "window.h"

#include <algorithm>
#include <utility>

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <renderer/gl/context.h>
#include <support/error.h>

#include "../interruption.h"
#include "pacing.h"

namespace experiment {
namespace {

std::string glfw_reason() {
    const char* text = nullptr;
    return glfwGetError(&text) != GLFW_NO_ERROR && text ? text : "no reason given";
}

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

void check_size(const char* what, int width, int height, int found_width, int found_height) {
    if (found_width < width || found_height < height) {
        throw support::input_error("{}: expected at least the stimulus's {}x{} pixels, found {}x{}", what,
                                   width, height, found_width, found_height);
    }
}

} // namespace

Window::Window(int width, int height, bool windowed) {
    if (glfwInit() == GLFW_FALSE) {
        throw support::failure("a session needs a display (or --simulate): {}", glfw_reason());
    }
    try {
        open(width, height, windowed);
    } catch (...) {
        glfwTerminate();
        throw;
    }
}

void Window::open(int width, int height, bool windowed) {
    // Make sure that the monitor can show a stimulus whole.
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    if (!mode) {
        throw support::failure("a session needs a monitor (or --simulate): {}", glfw_reason());
    }
    check_size("primary monitor", width, height, mode->width, mode->height);

    // Open the window with its context.
    set_hints();
    glfwWindowHint(GLFW_REFRESH_RATE, mode->refreshRate > 0 ? mode->refreshRate : GLFW_DONT_CARE);
    window_ = windowed ? glfwCreateWindow(width, height, "skin2afc", nullptr, nullptr)
                       : glfwCreateWindow(mode->width, mode->height, "skin2afc", monitor, nullptr);
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

    // Listen to the keyboard, and to what uncovers the window.
    glfwSetInputMode(window_, GLFW_CURSOR, GLFW_CURSOR_HIDDEN);
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int) {
        static_cast<Window*>(glfwGetWindowUserPointer(window))->on_key(key, action != GLFW_RELEASE);
    });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) {
        static_cast<Window*>(glfwGetWindowUserPointer(window))->damaged_ = true;
    });
}

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

std::array<int, 2> Window::framebuffer_size() const {
    std::array<int, 2> size{};
    glfwGetFramebufferSize(window_, &size[0], &size[1]);
    return size;
}

int Window::reported_hz() const {
    const GLFWvidmode* mode = glfwGetVideoMode(glfwGetPrimaryMonitor());
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

void Window::on_key(int key, bool down) {
    const auto meaning = key_of(key);
    if (!meaning) {
        return;
    }
    if (!down) {
        gate_.release(key);
    } else if (gate_.press(key)) {
        presses_.push_back({*meaning, monotonic_s()});
    }
}

void Window::poll() {
    glfwPollEvents();
    Interruption::check();
    if (glfwWindowShouldClose(window_) == GLFW_TRUE) {
        throw Interrupted("the window was closed");
    }
}

std::optional<Press> Window::pressed(std::initializer_list<Key> keys) const {
    const auto wanted = [&](const Press& press) {
        return std::find(keys.begin(), keys.end(), press.key) != keys.end();
    };
    const auto press = std::find_if(presses_.begin(), presses_.end(), wanted);
    return press == presses_.end() ? std::nullopt : std::optional(*press);
}

bool Window::take_damage() { return std::exchange(damaged_, false); }

} // namespace experiment
