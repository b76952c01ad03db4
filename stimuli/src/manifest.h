// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include <stimuli/render_set.h>

#include "recipe.h"

namespace stimuli {

/// DIR/manifest.json: what is in a folder of stimuli and how it was made. Several processes may add to one
/// folder; each change reads, merges and replaces the file under a lock.
class Manifest {
public:
    /// `header` holds the fields that describe the whole set: protocol, model, renderer.
    Manifest(std::filesystem::path folder, nlohmann::ordered_json header);

    /// The entries on disk by image name; none if there is no manifest or it cannot be understood.
    std::map<std::string, nlohmann::ordered_json> entries() const;

    /// Keep of the entries on disk only those whose "recipe" is the one given for their name.
    void keep_only(const std::map<std::string, std::string>& recipes);

    /// The digest of what the contact sheet in the folder was made from; empty if there is none.
    std::string contact_sheet_inputs() const;
    void note_contact_sheet(const std::string& inputs);

    /// Add or replace one image's entry.
    void add(const std::string& name, const nlohmann::ordered_json& entry);

private:
    nlohmann::ordered_json read() const;
    template <typename Change>
    void change(const Change& change);
    std::filesystem::path folder_;
    nlohmann::ordered_json header_;
};

/// The entry of a rendered image, less the digests of its files.
nlohmann::ordered_json manifest_entry(const Item& item, const Recipe& recipe, const Outcome& outcome);

} // namespace stimuli
