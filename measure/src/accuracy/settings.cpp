// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "settings.h"

#include <fmt/format.h>

#include <stimuli/setup.h>

namespace measure {
namespace {

namespace passes = renderer::passes;
using passes::Shader;

constexpr std::string_view six_gaussians = "skin_6g_deon2007", four_gaussians = "skin_4g_jimenez2010";

/// Collects settings around the protocol's own.
class Sweep {
public:
    Sweep(const study::Protocol& protocol, bool quick)
        : base_(stimuli::methods(protocol)), profile_(protocol.skin.profile), quick_(quick) {
        // The fit of skin with the other number of Gaussians; other materials have but one.
        if (profile_ == six_gaussians) {
            other_profile_ = four_gaussians;
            other_name_ = "4 Gaussians";
        } else if (profile_ == four_gaussians) {
            other_profile_ = six_gaussians;
            other_name_ = "6 Gaussians";
        }
    }

    std::vector<Setting> all() {
        add(Shader::no_sss, "default", base_);
        texture_space();
        screen_space();
        jittered();
        return std::move(settings_);
    }

private:
    void add(Shader shader, const std::string& name, const passes::Methods& methods) {
        settings_.push_back({shader, name, methods, profile_});
    }
    /// The same with the other number of Gaussians.
    void add_other_profile(Shader shader, const std::string& more, const passes::Methods& methods) {
        if (!other_profile_.empty()) {
            settings_.push_back({shader, other_name_ + more, methods, other_profile_});
        }
    }

    void texture_space() {
        add(Shader::ts, "default", base_);
        passes::Methods methods = base_;
        for (const int size : {256, 512, 1024, 2048, 4096}) {
            methods.ts.map_size = size;
            if (size != base_.ts.map_size && (!quick_ || size == 256)) {
                add(Shader::ts, fmt::format("map {}", size), methods);
            }
        }
        if (!quick_) {
            methods = base_;
            methods.ts.unblurred_first = !base_.ts.unblurred_first;
            add(Shader::ts,
                methods.ts.unblurred_first ? "first Gaussian unblurred" : "first Gaussian blurred", methods);
            add_other_profile(Shader::ts, "", base_);
        }
        methods = base_;
        methods.ts.map_size = 512;
        add_other_profile(Shader::ts, ", map 512", methods);
    }

    void screen_space() {
        add(Shader::ss_full, "default", base_);
        add_full("published", passes::published_full());
        add_other_profile(Shader::ss_full, "", base_);
        passes::FullMethod full = base_.full;
        for (const int taps : {7, 9, 13, 25}) {
            full.taps = taps;
            full.published_taps = false;
            if (taps != base_.full.taps && (!quick_ || taps == 13)) {
                add_full(fmt::format("{} taps", taps), full);
            }
        }
        for (const int bits : {8, 16, 32}) {
            full = base_.full;
            full.target_bits = bits;
            if (!quick_ || bits == 8) {
                add_full(fmt::format("{} bits", bits), full);
            }
        }
        full = base_.full;
        full.half_resolution = !base_.full.half_resolution;
        add_full(full.half_resolution ? "half resolution" : "full resolution", full);
        if (quick_) {
            return;
        }
        passes::Methods half = base_;
        half.full = full;
        add_other_profile(Shader::ss_full, full.half_resolution ? ", half resolution" : ", full resolution",
                          half);
        full = base_.full;
        full.foreshortening = base_.full.foreshortening == passes::Foreshortening::exact
                                  ? passes::Foreshortening::published
                                  : passes::Foreshortening::exact;
        add_full(full.foreshortening == passes::Foreshortening::exact ? "exact stretch" : "published stretch",
                 full);
        full = base_.full;
        full.reject_gaps = !base_.full.reject_gaps;
        add_full(full.reject_gaps ? "gaps rejected" : "gaps not rejected", full);
        full = base_.full;
        full.published_taps = !base_.full.published_taps;
        add_full(full.published_taps ? "published taps" : "fitted taps", full);
        passes::Methods published = base_;
        published.full = passes::published_full();
        add_other_profile(Shader::ss_full, ", published", published);
        full = base_.full;
        full.taps = 25;
        full.target_bits = 32;
        full.half_resolution = false;
        add_full("25 taps, 32 bits", full);
    }
    void add_full(const std::string& name, const passes::FullMethod& full) {
        passes::Methods methods = base_;
        methods.full = full;
        add(Shader::ss_full, name, methods);
    }

    void jittered() {
        add(Shader::ss_jittered, "default", base_);
        passes::Methods methods = base_;
        for (const int taps : {13, 25, 49}) {
            methods.jittered.taps = taps;
            if (taps != base_.jittered.taps && (!quick_ || taps == 49)) {
                add(Shader::ss_jittered, fmt::format("{} taps", taps), methods);
            }
        }
    }

    passes::Methods base_;
    std::string profile_, other_profile_, other_name_;
    bool quick_;
    std::vector<Setting> settings_;
};

} // namespace

std::vector<Setting> settings(const study::Protocol& protocol, bool quick) {
    return Sweep(protocol, quick).all();
}

} // namespace measure
