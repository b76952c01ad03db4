// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <study/protocol.h>

/// Errors as in Figure 9 of [Jimenez2009]: how far each shader is from the truth in one view.
struct ViewErrors {
    std::string view; ///< "<distance>_<azimuth>"
    std::map<std::string, double>
        rmse; ///< by shader; over the head's pixels, linear light, mean of the channels' squares

    /// As the paper found: `ss_full` nearest, `no_sss` farthest.
    bool ordered() const;
};

/// The errors of every view of a protocol, from the linear images in a folder. The paper takes `ts` for the
/// truth.
std::vector<ViewErrors> figure9(const study::Protocol& protocol, const std::filesystem::path& folder,
                                const std::string& truth = "ts");
