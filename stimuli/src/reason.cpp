// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "reason.h"

#include <support/file.h>

namespace stimuli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Which parameters differ from those that the image was rendered with.
std::string changed_parameters(const Json& entry, const Recipe& recipe) {
    std::string names;
    for (const auto& [key, value] : recipe.parameters.items()) {
        const Json& before = entry["parameters"];
        const bool same = before.contains(key) && before[key] == value;
        if (!same) {
            names += (names.empty() ? "" : ", ") + key;
        }
    }
    return "changed: " + names;
}

} // namespace

std::string reason_to_render(const std::string& name, const Recipe& recipe, const Json* entry,
                             const SetRequest& request) {
    if (request.force) {
        return "forced";
    }
    if (!entry) {
        return "new";
    }
    if ((*entry)["recipe"].get<std::string>() != recipe.digest) {
        return changed_parameters(*entry, recipe);
    }
    const fs::path file = request.out / (name + ".png");
    if (!fs::exists(file) || support::sha256_of_file(file) != (*entry)["sha256"].get<std::string>()) {
        return "its file is missing or changed";
    }
    const fs::path linear = request.out / (name + ".exr");
    if (request.exr && !(entry->contains("exr_sha256") && fs::exists(linear) &&
                         (*entry)["exr_sha256"] == support::sha256_of_file(linear))) {
        return "its linear image is missing or changed";
    }
    return up_to_date;
}

} // namespace stimuli
