// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace fixture {

/// An X server of its own without hardware (Xvfb) whose screen can be read and whose keys can be pressed; the
/// environment's DISPLAY leads to it. Needs the programs Xvfb and xdotool; throws std::runtime_error without.
class VirtualScreen {
public:
    VirtualScreen(const std::filesystem::path& folder, int width, int height);
    ~VirtualScreen();
    VirtualScreen(const VirtualScreen&) = delete;
    VirtualScreen& operator=(const VirtualScreen&) = delete;

    /// Red, green and blue at a pixel, the first row on top.
    std::array<std::uint8_t, 3> pixel(int x, int y) const;
    /// Wait until the pixel has that colour; whether it got it in 20 seconds.
    bool becomes(int x, int y, const std::array<std::uint8_t, 3>& rgb) const;

    /// Keep the whole screen as a picture; whether it has more than one colour.
    bool save(const std::filesystem::path& png) const;

    /// Press and release a key, by its X name: "space", "1", "KP_2".
    static void key(const std::string& name);
    static void key_down(const std::string& name);
    static void key_up(const std::string& name);
    /// Anything else that xdotool does.
    static void act(const std::vector<std::string>& words);
    /// Ask the program to close its window, as a window manager's cross does.
    static void ask_to_close();
    /// Take the keyboard from the program's window, or give it back.
    static void focus(bool window);

private:
    std::filesystem::path framebuffer_;
    int width_, height_;
    pid_t server_ = -1;
};

} // namespace fixture
