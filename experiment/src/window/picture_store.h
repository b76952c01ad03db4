// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <map>

#include <renderer/gl/objects.h>

#include "../stage.h"
#include "../stimulus_set.h"
#include "page.h"

namespace experiment {

/// A picture on the GPU.
class GpuPicture {
public:
    explicit GpuPicture(const Pixels& pixels);
    /// Draw it into the window's back buffer, centred on whole pixels; none is scaled.
    void draw(const std::array<int, 2>& framebuffer_size) const;

private:
    renderer::gl::Texture texture_;
    renderer::gl::Framebuffer framebuffer_;
};

/// All the pictures of a session on the GPU, so that nothing is loaded between trials. Needs a current
/// context.
class PictureStore {
public:
    /// Decode and upload every picture of the set; `between` is called after each. Throws support::InputError
    /// for a picture that does not decode.
    template <typename Between>
    PictureStore(const StimulusSet& set, Between between) {
        for (const auto& [stimulus, file] : set.files()) {
            stimuli_.emplace(stimulus, GpuPicture(decode(file)));
            between();
        }
    }

    /// Upload pictures that are there already.
    explicit PictureStore(const std::map<Stimulus, Pixels>& pictures) {
        for (const auto& [stimulus, pixels] : pictures) {
            stimuli_.emplace(stimulus, GpuPicture(pixels));
        }
    }

    /// Draw a picture into the window's back buffer, and wait until it is there.
    void draw(const Picture& picture, const std::array<int, 2>& framebuffer_size) const;

private:
    static Pixels decode(const fs::path& file);
    std::map<Stimulus, GpuPicture> stimuli_;
};

/// Draw a picture that is no stimulus.
void draw_grey(double level);
void draw_page(const std::string& text, const std::array<int, 2>& framebuffer_size);

} // namespace experiment
