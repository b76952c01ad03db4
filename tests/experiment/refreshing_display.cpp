// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

// A library that a test loads before GLFW, to have a display whose swaps wait for a refresh and whose cable
// can be pulled, which a virtual screen has not. SKIN2AFC_TEST_CABLE, where set, is a file; where that is
// gone, so is the monitor. SKIN2AFC_TEST_HZ is its rate; SKIN2AFC_TEST_DROPS, where set, the number of swaps
// from one that comes a refresh late to the next.

#include <cmath>
#include <cstdlib>

#include <dlfcn.h>
#include <time.h>
#include <unistd.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace {

GLFWmonitorfun monitor_changed = nullptr;

double setting(const char* name) {
    const char* const text = std::getenv(name);
    return text ? std::atof(text) : 0;
}

double now_s() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <typename Function>
Function original(const char* name) {
    return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

} // namespace

extern "C" {

void glfwSwapBuffers(GLFWwindow* window) {
    static long swaps = 0;
    // A file, where it is named, says that the rate has changed meanwhile.
    const char* const changed = std::getenv("SKIN2AFC_TEST_CHANGED");
    const bool now_other = changed && ::access(changed, F_OK) == 0;
    const double hz = setting(now_other ? "SKIN2AFC_TEST_OTHER_HZ" : "SKIN2AFC_TEST_HZ");
    if (!(hz > 0)) {
        return original<void (*)(GLFWwindow*)>("glfwSwapBuffers")(window);
    }
    const auto drops = static_cast<long>(setting("SKIN2AFC_TEST_DROPS"));
    const double late = drops > 0 && ++swaps % drops == 0 ? 1 : 0;
    const double refresh_s = (std::floor(now_s() * hz) + 1 + late) / hz;
    // Refreshes keep their times better than a sleeper wakes.
    constexpr double spun_s = 3e-3;
    if (const double sleep_s = refresh_s - now_s() - spun_s; sleep_s > 0) {
        const timespec pause{0, static_cast<long>(1e9 * sleep_s)};
        ::nanosleep(&pause, nullptr);
    }
    while (now_s() < refresh_s) {
    }
    original<void (*)(GLFWwindow*)>("glfwSwapBuffers")(window);
}

GLFWmonitorfun glfwSetMonitorCallback(GLFWmonitorfun callback) {
    monitor_changed = callback;
    return original<GLFWmonitorfun (*)(GLFWmonitorfun)>("glfwSetMonitorCallback")(callback);
}

void glfwPollEvents() {
    original<void (*)()>("glfwPollEvents")();
    static bool plugged_in = true;
    const char* const cable = std::getenv("SKIN2AFC_TEST_CABLE");
    if (const bool now = !cable || ::access(cable, F_OK) == 0; now != plugged_in && monitor_changed) {
        plugged_in = now;
        monitor_changed(glfwGetPrimaryMonitor(), now ? GLFW_CONNECTED : GLFW_DISCONNECTED);
    }
}

const GLFWvidmode* glfwGetVideoMode(GLFWmonitor* monitor) {
    static GLFWvidmode mode;
    const GLFWvidmode* const real =
        original<const GLFWvidmode* (*)(GLFWmonitor*)>("glfwGetVideoMode")(monitor);
    if (!real) {
        return nullptr;
    }
    mode = *real;
    if (const double hz = setting("SKIN2AFC_TEST_HZ"); hz > 0) {
        mode.refreshRate = static_cast<int>(hz);
    }
    return &mode;
}
}
