// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include <renderer/scene/appearance.h>
#include <renderer/scene/camera.h>
#include <renderer/scene/frame.h>
#include <renderer/scene/model.h>

namespace renderer::reference {

/// What trades time for error; the defaults have converged (see the module's README).
struct Settings {
    int samples_per_side = 4; ///< rays a pixel: the square of this, 1 to 64
    /// Surface cells per standard deviation of a Gaussian, along each side: .25 to 8. Cells decide how finely
    /// the light that enters is known; a sum over them is exact to about 1e-4 from 1 on.
    double cells_per_sigma = 1.2;
    std::size_t most_cells = 16'000'000; ///< beyond this, cells grow: about 150 bytes of memory each
};

/// SHA-256 of this renderer's sources: changes when the pictures may.
std::string code_digest();

/// Seconds spent in each stage since the renderer was made.
using StageSeconds = std::map<std::string, double>;

/// Called now and then, on the thread that renders, with the share of the work done, 0 to 1.
using Progress = std::function<void(double)>;

/// The light transport that the real-time shaders approximate, computed on the CPU: shadows by rays, and
/// diffusion as the sum over the model's whole surface, sum_j E_j A_j R(|x - x_j|), of the light that enters
/// there times the profile at the distance in space, not normalised. Material, camera, bloom and output are
/// those of the passes. Shadow map size and softness, and Look::samples, mean nothing here. The same input
/// gives the same bytes, whatever the number of threads.
class Reference {
public:
    /// The model outlives the renderer. Throws support::InputError for settings out of range or a profile
    /// without finite, non-negative variances and finite weights, support::Failure if Embree fails.
    Reference(const scene::Model& model, const scene::Look& look, const Settings& settings = {});
    ~Reference();
    Reference(const Reference&) = delete;
    Reference& operator=(const Reference&) = delete;

    /// Throws support::InputError for a camera or a light that is not finite, an image without pixels, a
    /// light without direction, or a view that needs far more than most_cells.
    scene::Frame render(const scene::Camera& camera, const scene::Light& light, bool with_linear = false,
                        const Progress& progress = {});

    const StageSeconds& seconds() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace renderer::reference
