// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <study/session.h>

#include "../stage.h"
#include "display.h"
#include "key_gate.h"

struct GLFWwindow;

namespace experiment {

/// The participant's window: full screen or of the stimulus's size, with a current OpenGL 4.5 core context
/// made through EGL, and the keyboard. One at a time.
class Window {
public:
    /// Open it, hide the pointer. `leave` ends the session. Throws support::Failure without display or
    /// OpenGL 4.5, and support::InputError where its framebuffer is smaller than width x height pixels.
    Window(int width, int height, const ScreenOptions& options, const study::KeyChord& leave);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    GLFWwindow* handle() const { return window_; }
    GLFWmonitor* monitor() const { return monitor_; }
    std::array<int, 2> framebuffer_size() const;
    /// The monitor's own word on its refresh rate, 0 where it does not know.
    int reported_hz() const;
    void hide_pointer() const;
    /// Notice monitors that come and go; anew after another library has taken GLFW's only callback for it.
    void listen_to_monitors();

    /// Swap the buffers, and wait until the display server has done what it was asked to.
    void swap();
    /// Wait until the back buffer can be drawn again, that is, where swaps wait for the display's refresh,
    /// until the swapped picture is out.
    void wait_for_back_buffer();

    /// Look at keyboard and window once. Throws Interrupted for the keys that end a session, or a signal.
    void poll();
    /// Forget the presses so far.
    void clear_presses();
    /// The first press among the keys since then.
    std::optional<Press> pressed(std::initializer_list<Key> keys) const;
    /// Every key that went down since the last call, by GLFW's number.
    std::vector<int> take_keys() { return std::exchange(keys_, {}); }
    /// Whether the window's content was damaged since the last call.
    bool take_damage() { return std::exchange(damaged_, false); }
    /// Whether someone asked to close the window since the last call.
    bool take_close();
    /// Whether the window's size or the monitors changed since the last call.
    bool take_change() { return std::exchange(changed_, false); }
    std::vector<Note> take_notes() { return std::exchange(notes_, {}); }

private:
    void open(int width, int height, const ScreenOptions& options);
    void listen();
    void on_key(int key, int scancode, int action, int modifiers);
    bool ends_session(int key, int scancode, int modifiers) const;

    Glfw glfw_;
    GLFWmonitor* monitor_ = nullptr;
    GLFWwindow* window_ = nullptr;
    study::KeyChord leave_;
    KeyGate gate_;
    std::vector<Press> presses_;
    std::vector<int> keys_;
    std::vector<Note> notes_;
    bool damaged_ = false, changed_ = false, leaving_ = false;
};

} // namespace experiment
