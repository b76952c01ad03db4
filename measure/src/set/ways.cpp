// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "ways.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>
#include <toml++/toml.h>

#include <stimuli/render_set.h>
#include <study/protocol.h>
#include <support/error.h>
#include <support/file.h>

#include "../accuracy/settings.h"
#include "child.h"

namespace measure {
namespace {

namespace fs = std::filesystem;
namespace passes = renderer::passes;

// A quick look divides sides by so much, and keeps so many distances and azimuths.
constexpr int quick_divisor = 4;
constexpr std::size_t quick_values = 2;
constexpr int smallest_side = 16;

passes::Switches all_off() {
    passes::Switches switches;
    for (const passes::SwitchEntry& entry : passes::switch_list) {
        switches.*entry.member = false;
    }
    return switches;
}

void divide(toml::table& table, std::string_view key, int value) {
    table.insert_or_assign(key, std::max(smallest_side, value / quick_divisor));
}

void keep_first(toml::node* node) {
    if (toml::array* array = node ? node->as_array() : nullptr; array && array->size() > quick_values) {
        array->resize(quick_values, 0);
    }
}

/// The same protocol with fewer and smaller images.
std::string made_smaller(const study::Protocol& protocol, const std::string& text) {
    toml::table table = toml::parse(text);
    const auto section = [&](const char* name) -> toml::table& {
        if (!table.contains(name)) {
            table.insert(name, toml::table());
        }
        return *table[name].as_table();
    };
    divide(section("image"), "width", protocol.image.width);
    divide(section("image"), "height", protocol.image.height);
    divide(section("light"), "shadow_map_size", protocol.light.shadow_map_size);
    keep_first(section("light").get("azimuths_deg"));
    keep_first(section("camera").get("distances"));
    std::ostringstream smaller;
    smaller << table << "\n";
    return smaller.str();
}

/// The program's arguments for one image, or for all.
std::vector<std::string> arguments(const SetInput& input, const fs::path& folder) {
    std::vector<std::string> result{"stimuli", input.protocol_file.string(), "--out", folder.string()};
    if (input.model_file) {
        result.insert(result.end(), {"--model", input.model_file->string()});
    }
    return result;
}

} // namespace

std::vector<Way> ways() {
    std::vector<Way> result{{row_everything, "on", Way::How::here, {}, true, 0}};
    double bounds = 0;
    for (const passes::SwitchEntry& entry : passes::switch_list) {
        Way way{std::string(entry.name), "off", Way::How::here, {}, true, entry.bound};
        way.switches.*entry.member = false;
        result.push_back(way);
        bounds += entry.bound;
    }
    result.push_back({row_overlap, "off", Way::How::here, {}, false, 0});
    result.push_back({row_everything, "off", Way::How::here, all_off(), false, bounds});
    result.push_back({row_program, state_one_run, Way::How::one_run, {}, true, 0});
    result.push_back({row_program, state_run_an_image, Way::How::run_an_image, {}, true, 0});
    return result;
}

SetInput set_input(const SetBenchRequest& request, const fs::path& scratch) {
    SetInput input{request.protocol_file.value_or(scratch / "jimenez2009.toml"), request.model_file};
    if (!request.protocol_file) {
        support::write_atomically(input.protocol_file, study_of_2009_text());
    }
    if (request.quick) {
        const study::Protocol protocol = study::read_protocol(input.protocol_file);
        if (!input.model_file && protocol.model.file) { // which stands relative to the protocol's folder
            input.model_file = input.protocol_file.parent_path() / *protocol.model.file;
        }
        const std::string text = made_smaller(protocol, support::read_text(input.protocol_file));
        input.protocol_file = scratch / "quick.toml";
        support::write_atomically(input.protocol_file, text);
    }
    return input;
}

SetFacts facts_of(const fs::path& folder) {
    const auto manifest = nlohmann::json::parse(support::read_text(folder / "manifest.json"));
    SetFacts facts;
    facts.driver = manifest["renderer"];
    facts.model = manifest["model"]["name"];
    for (const auto& image : manifest["images"]) {
        facts.digests[image["file"]] = image["sha256"];
        facts.passes += static_cast<long long>(image["passes_run"].size());
        for (const auto& [what, count] : image["counts"].items()) {
            facts.counts[what] += count.get<long long>();
        }
    }
    return facts;
}

void render_in_way(const Way& way, const SetInput& input, const fs::path& program, const fs::path& folder) {
    if (way.how == Way::How::here) {
        stimuli::SetRequest request;
        request.protocol_file = input.protocol_file;
        request.model_file = input.model_file;
        request.out = folder;
        request.overlap = way.overlap;
        request.switches = way.switches;
        request.quiet = true;
        stimuli::render_set(request);
        return;
    }
    if (way.how == Way::How::one_run) {
        run_program(program, arguments(input, folder));
        return;
    }
    const study::Protocol protocol = study::read_protocol(input.protocol_file);
    for (const int azimuth : protocol.light.azimuths_deg) {
        for (const study::Distance& distance : protocol.camera.distances) {
            for (const std::string& shader : protocol.shaders) {
                std::vector<std::string> one = arguments(input, folder);
                for (const std::string& only :
                     {"shader=" + shader, "distance=" + distance.name, fmt::format("azimuth={}", azimuth)}) {
                    one.insert(one.end(), {"--only", only});
                }
                run_program(program, one);
            }
        }
    }
}

} // namespace measure
