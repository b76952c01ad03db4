// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace measure {

/// The name of the processor, as Linux has it.
std::string processor_name();

} // namespace measure
