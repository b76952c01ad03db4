// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <set>

namespace experiment {

/// Decides which presses count: a key's repeats never do, and none does while another key is held down, so
/// that each counted press has its own release.
class KeyGate {
public:
    /// A key went down, or repeats; whether that counts.
    bool press(int key) {
        const bool none_held = held_.empty();
        held_.insert(key);
        return none_held;
    }
    void release(int key) { held_.erase(key); }

private:
    std::set<int> held_;
};

} // namespace experiment
