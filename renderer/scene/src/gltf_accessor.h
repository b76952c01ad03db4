// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tiny_gltf.h>

namespace renderer::scene {

/// Checked reading of glTF accessors: every index, offset, count and value is verified before it is used.
class AccessorReader {
public:
    AccessorReader(const tinygltf::Model& model, std::string file) : model_(model), file_(std::move(file)) {}

    /// The accessor's numbers as floats, `components` an element, normalised integers mapped to [0, 1] or
    /// [-1, 1]. Throws support::InputError for anything out of bounds, of the wrong type, or not finite.
    /// `what` names it.
    std::vector<float> floats(int accessor, int components, const std::string& what) const;

    /// Unsigned integers of any width.
    std::vector<std::uint32_t> indices(int accessor, const std::string& what) const;

    /// The bytes of a buffer view.
    std::vector<std::uint8_t> view_bytes(int view, const std::string& what) const;

private:
    struct Range {
        const std::uint8_t* first;
        std::size_t count, stride;
    };
    const tinygltf::Accessor& checked(int accessor, int components, const std::string& what) const;
    Range range(const tinygltf::Accessor& accessor, std::size_t element_bytes, const std::string& what) const;
    const tinygltf::BufferView& checked_view(int view, const std::string& what) const;

    const tinygltf::Model& model_;
    std::string file_;
};

} // namespace renderer::scene
