// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <vector>

#include "../stage.h"
#include "key_gate.h"

struct GLFWwindow;

namespace experiment {

/// The participant's window: full screen or of the stimulus's size, with a current OpenGL 4.5 core context
/// made through EGL, and the keyboard. One at a time.
class Window {
public:
    /// Open it, hide the pointer. Throws support::Failure without display or OpenGL 4.5, and
    /// support::InputError where its framebuffer is smaller than width x height pixels.
    Window(int width, int height, bool windowed);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    std::array<int, 2> framebuffer_size() const;
    /// The monitor's own word on its refresh rate, 0 where it does not know.
    int reported_hz() const;

    /// Swap the buffers, and wait until the display server has done what it was asked to.
    void swap();
    /// Wait until the back buffer can be drawn again, that is, where swaps wait for the display's refresh,
    /// until the swapped picture is out.
    void wait_for_back_buffer();

    /// Look at keyboard and window once. Throws Interrupted for a closed window or a signal.
    void poll();
    /// Forget the presses so far.
    void clear_presses() { presses_.clear(); }
    /// The first press among the keys since then.
    std::optional<Press> pressed(std::initializer_list<Key> keys) const;
    /// Whether the window's content was damaged since the last call.
    bool take_damage();

private:
    void open(int width, int height, bool windowed);
    void on_key(int key, bool down);

    GLFWwindow* window_ = nullptr;
    KeyGate gate_;
    std::vector<Press> presses_;
    bool damaged_ = false;
};

} // namespace experiment
