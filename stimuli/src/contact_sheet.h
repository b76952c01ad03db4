// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <renderer/passes/pipeline.h>
#include <study/protocol.h>

namespace stimuli {

/// All images of a protocol, small and labelled: a row a view, a column a shader. Where there are many
/// images they are smaller, so that the sheet has 64 million pixels at most.
class ContactSheet {
public:
    explicit ContactSheet(const study::Protocol& protocol);

    /// Paste an image of the protocol's size, by its stem: 8-bit sRGB, `channels` (3 or 4) a pixel, rows from
    /// the top down. An image that has no place here is passed over. Different images may be pasted by
    /// different threads at once.
    void paste(const std::string& name, const std::uint8_t* pixels, int channels);

    /// Write FOLDER/contact_sheet.png; images that nobody has pasted are read from the folder. Throws
    /// support::Failure, and support::InputError for an image that cannot be read or has another size.
    void write(const std::filesystem::path& folder);

    std::size_t pixels() const { return sheet_.srgb.size() / 3; }

private:
    struct Cell {
        std::string name;
        int left = 0, top = 0;
        bool pasted = false;
    };
    int width_, height_, shrink_;
    std::vector<Cell> cells_;
    renderer::passes::Frame sheet_;
};

} // namespace stimuli
