// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "schedule.h"

namespace experiment {

namespace fs = std::filesystem;

/// A folder of rendered pictures whose manifest vouches for them.
class StimulusSet {
public:
    /// Read FOLDER/manifest.json and check that each of `needed` is listed, present, unchanged since it was
    /// rendered (SHA-256) and an 8-bit picture of width x height pixels. Throws support::InputError that
    /// names the first picture that is not.
    StimulusSet(fs::path folder, const std::vector<Stimulus>& needed, int width, int height);

    const fs::path& folder() const { return folder_; }
    /// The file of a picture that was needed.
    const fs::path& file_of(const Stimulus& stimulus) const { return files_.at(stimulus); }
    const std::map<Stimulus, fs::path>& files() const { return files_; }
    /// SHA-256 of a picture that was needed.
    const std::string& digest_of(const Stimulus& stimulus) const { return digests_.at(stimulus); }
    /// SHA-256 of the manifest, which names every picture's own.
    const std::string& manifest_digest() const { return manifest_digest_; }

    /// SHA-256 of the protocol that the manifest names; empty if it names none.
    const std::string& protocol_digest() const { return protocol_digest_; }

private:
    fs::path folder_;
    std::map<Stimulus, fs::path> files_;
    std::map<Stimulus, std::string> digests_;
    std::string manifest_digest_, protocol_digest_;
};

} // namespace experiment
