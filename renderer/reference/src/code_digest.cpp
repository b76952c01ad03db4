// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <renderer/reference/reference.h>

namespace renderer::reference {

std::string code_digest() { return CODE_DIGEST; }

} // namespace renderer::reference
