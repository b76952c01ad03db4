// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>

#include <study/protocol.h>

namespace stimuli {

/// Make FOLDER/contact_sheet.png from the images in the folder: a row a view, a column a shader, labelled.
/// Throws support::Failure.
void write_contact_sheet(const std::filesystem::path& folder, const study::Protocol& protocol);

} // namespace stimuli
