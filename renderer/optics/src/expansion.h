// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <string_view>

#include <glm/glm.hpp>

#include <renderer/optics/profile.h>

namespace renderer::optics {

/// The integral over t of density(t) times Gaussians of variance 1 / 2t^2, as a sum of Gaussians from the
/// narrowest to the widest, divided by `total`, the integral of the density. What the range leaves out goes
/// to the narrowest.
Profile sum_of_gaussians(const std::function<glm::dvec3(double)>& density, const glm::dvec3& total,
                         double narrowest_mm, double widest_mm, std::string_view name);

} // namespace renderer::optics
