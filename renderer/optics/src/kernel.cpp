// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <renderer/optics/kernel.h>

namespace renderer::optics {

std::vector<Tap> hable_kernel() {
    std::vector<Tap> taps{
        {{0.000000f, 0.000000f}, {0.220441f, 0.437000f, 0.635000f}},
        {{1.633992f, 0.036795f}, {0.076356f, 0.064487f, 0.039097f}},
        {{0.177801f, 1.717592f}, {0.116515f, 0.103222f, 0.064912f}},
        {{-0.194906f, 0.091094f}, {0.064844f, 0.086388f, 0.062272f}},
        {{-0.239737f, -0.220217f}, {0.131798f, 0.151695f, 0.103676f}},
        {{-0.003530f, -0.118219f}, {0.025690f, 0.042728f, 0.033003f}},
        {{1.320107f, -0.181542f}, {0.048593f, 0.064740f, 0.046131f}},
        {{5.970690f, 0.253378f}, {0.048092f, 0.003042f, 0.000400f}},
        {{-1.089250f, 4.958349f}, {0.048845f, 0.005406f, 0.001222f}},
        {{-4.015465f, 4.156699f}, {0.051322f, 0.006034f, 0.001420f}},
        {{-4.063099f, -4.110150f}, {0.061428f, 0.009152f, 0.002511f}},
        {{-0.638605f, -6.297663f}, {0.030936f, 0.002868f, 0.000652f}},
        {{2.542348f, -3.245901f}, {0.073580f, 0.023239f, 0.009703f}},
    };
    glm::vec3 sum{0};
    for (const Tap& tap : taps) {
        sum += tap.weight;
    }
    for (Tap& tap : taps) {
        tap.weight /= sum;
    }
    return taps;
}

glm::vec3 rms_radius(const std::vector<Tap>& kernel) {
    glm::vec3 sum{0};
    for (const Tap& tap : kernel) {
        sum += tap.weight * glm::dot(tap.offset, tap.offset);
    }
    return glm::sqrt(sum);
}

} // namespace renderer::optics
