// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <stats/study.h>

namespace stats {

/// What a data set's description says; absent and false where it says nothing.
struct Description {
    std::optional<std::string> name;
    bool simulated = false;
};

/// Read dataset_description.json, or a log's sidecar; a file that is not there says nothing. Throws
/// support::InputError for one that is no JSON object, or has a field of another type than the format has.
Description read_description(const std::filesystem::path& file);
Sidecar read_sidecar(const std::filesystem::path& file);

} // namespace stats
