// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <renderer/scene/appearance.h>
#include <renderer/scene/camera.h>
#include <renderer/scene/frame.h>
#include <renderer/scene/model.h>

namespace measure {

/// A scene whose diffused light has a closed form.
struct ClosedForm {
    std::string name;
    renderer::scene::Model model;
    renderer::scene::Look look;
    renderer::scene::Light light;
    glm::dvec3 level{1}; ///< the light that errors are shares of
    /// The light at a place of the image, in pixels from its top left corner; nothing where it is not asked
    /// for.
    std::function<std::optional<glm::dvec3>(const renderer::scene::Camera&, double x_px, double y_px)> truth;
};

/// A plane lit on one half, turned about the vertical by an angle: sums of error functions, compared within 6
/// mm of the edge.
ClosedForm half_lit_plane(const renderer::optics::Profile& profile, double tilt_deg);
/// A lit square of 1 mm on a dark plane, the kernel itself but for the square's size: products of error
/// functions.
ClosedForm lit_dot(const renderer::optics::Profile& profile);
/// A sphere of 40 mm radius, the same light entering everywhere: it stays so but for the share
/// exp(-(2 radius)^2 / 2v) of each Gaussian, which is below 1e-100.
ClosedForm lit_sphere(const renderer::optics::Profile& profile);
/// A plane lit everywhere, far from its border: energy is kept.
ClosedForm lit_plane(const renderer::optics::Profile& profile);

/// All of them, planes at 0, 30 and 60 degrees.
std::vector<ClosedForm> closed_forms(const renderer::optics::Profile& profile);

/// A camera on the z axis that looks at the origin.
renderer::scene::Camera frontal_camera(double distance_mm, double fov_deg, int width, int height);

/// Root mean square error of a frame with linear light over the pixels that the scene covers wholly and has a
/// truth for, as a share of its level. Throws support::Failure if there are none.
double closed_form_error(const ClosedForm& scene, const renderer::scene::Camera& camera,
                         const renderer::scene::Frame& frame);

} // namespace measure
