// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <string>
#include <vector>

#include <study/protocol.h>

namespace experiment {

/// Refuse texts that would not fit on a page of that size, or hold letters that no font has. Throws
/// support::InputError that names the field, support::Failure without a font.
void check_texts(const study::Protocol& protocol, std::size_t trials, const std::array<int, 2>& size);

/// Every text that forms show of a protocol.
std::vector<std::string> form_texts(const study::Protocol& protocol);

} // namespace experiment
