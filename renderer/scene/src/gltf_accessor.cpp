// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <support/error.h>

namespace renderer::scene {
namespace {

template <typename T>
T read_as(const std::uint8_t* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

/// One component as a float; integers are normalised as glTF 2.0, section 3.6.2.2 says.
float component(const std::uint8_t* bytes, int type) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return read_as<float>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return static_cast<float>(*bytes) / 255.0f;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return static_cast<float>(read_as<std::uint16_t>(bytes)) / 65535.0f;
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return std::max(static_cast<float>(read_as<std::int8_t>(bytes)) / 127.0f, -1.0f);
    default:
        return std::max(static_cast<float>(read_as<std::int16_t>(bytes)) / 32767.0f, -1.0f);
    }
}

} // namespace

const tinygltf::BufferView& AccessorReader::checked_view(int view, const std::string& what) const {
    if (view < 0 || static_cast<std::size_t>(view) >= model_.bufferViews.size()) {
        throw support::input_error("{}: {}: expected a buffer view below {}, found {}", file_, what,
                                   model_.bufferViews.size(), view);
    }
    const tinygltf::BufferView& found = model_.bufferViews[static_cast<std::size_t>(view)];
    if (found.buffer < 0 || static_cast<std::size_t>(found.buffer) >= model_.buffers.size()) {
        throw support::input_error("{}: {}: expected a buffer below {}, found {}", file_, what,
                                   model_.buffers.size(), found.buffer);
    }
    const std::size_t size = model_.buffers[static_cast<std::size_t>(found.buffer)].data.size();
    if (found.byteOffset > size || found.byteLength > size - found.byteOffset) {
        throw support::input_error(
            "{}: {}: expected a view inside a buffer of {} bytes, found bytes {} to {}", file_, what, size,
            found.byteOffset, found.byteOffset + found.byteLength);
    }
    return found;
}

std::vector<std::uint8_t> AccessorReader::view_bytes(int view, const std::string& what) const {
    const tinygltf::BufferView& found = checked_view(view, what);
    const std::uint8_t* first =
        model_.buffers[static_cast<std::size_t>(found.buffer)].data.data() + found.byteOffset;
    return {first, first + found.byteLength};
}

const tinygltf::Accessor& AccessorReader::checked(int accessor, int components,
                                                  const std::string& what) const {
    if (accessor < 0 || static_cast<std::size_t>(accessor) >= model_.accessors.size()) {
        throw support::input_error("{}: {}: expected an accessor below {}, found {}", file_, what,
                                   model_.accessors.size(), accessor);
    }
    const tinygltf::Accessor& found = model_.accessors[static_cast<std::size_t>(accessor)];
    if (found.sparse.isSparse) {
        throw support::input_error("{}: {}: expected a dense accessor, found a sparse one (not supported)",
                                   file_, what);
    }
    const int has = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(found.type));
    if (has != components) {
        throw support::input_error("{}: {}: expected {} components, found {}", file_, what, components, has);
    }
    return found;
}

AccessorReader::Range AccessorReader::range(const tinygltf::Accessor& accessor, std::size_t element_bytes,
                                            const std::string& what) const {
    const tinygltf::BufferView& view = checked_view(accessor.bufferView, what);
    const std::size_t stride = view.byteStride > 0 ? view.byteStride : element_bytes;
    // The last element must end inside the view; written so that hostile counts do not overflow.
    const std::size_t room =
        accessor.byteOffset <= view.byteLength ? view.byteLength - accessor.byteOffset : 0;
    const bool fits = accessor.count > 0 && stride >= element_bytes && room >= element_bytes &&
                      accessor.count - 1 <= (room - element_bytes) / stride;
    if (!fits) {
        throw support::input_error("{}: {}: expected {} elements of {} bytes, found a view of {} bytes",
                                   file_, what, accessor.count, element_bytes, room);
    }
    const std::uint8_t* data = model_.buffers[static_cast<std::size_t>(view.buffer)].data.data();
    return {data + view.byteOffset + accessor.byteOffset, accessor.count, stride};
}

std::vector<float> AccessorReader::floats(int accessor, int components, const std::string& what) const {
    const tinygltf::Accessor& found = checked(accessor, components, what);
    const int type = found.componentType;
    const bool integer =
        type == TINYGLTF_COMPONENT_TYPE_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
        type == TINYGLTF_COMPONENT_TYPE_SHORT || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    if (type != TINYGLTF_COMPONENT_TYPE_FLOAT && !(integer && found.normalized)) {
        throw support::input_error("{}: {}: expected floats or normalised integers, found component type {}",
                                   file_, what, type);
    }
    const auto size =
        static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type)));
    const auto width = static_cast<std::size_t>(components);
    const Range elements = range(found, size * width, what);
    std::vector<float> values;
    values.reserve(elements.count * width);
    for (std::size_t i = 0; i < elements.count; ++i) {
        for (std::size_t j = 0; j < width; ++j) {
            const float value = component(elements.first + i * elements.stride + j * size, type);
            if (!std::isfinite(value)) {
                throw support::input_error("{}: {}: expected finite numbers, found {} at element {}", file_,
                                           what, value, i);
            }
            values.push_back(value);
        }
    }
    return values;
}

std::vector<std::uint32_t> AccessorReader::indices(int accessor, const std::string& what) const {
    const tinygltf::Accessor& found = checked(accessor, 1, what);
    const int type = found.componentType;
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
        throw support::input_error("{}: {}: expected unsigned integers, found component type {}", file_, what,
                                   type);
    }
    const auto size =
        static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type)));
    const Range elements = range(found, size, what);
    std::vector<std::uint32_t> values;
    values.reserve(elements.count);
    for (std::size_t i = 0; i < elements.count; ++i) {
        const std::uint8_t* bytes = elements.first + i * elements.stride;
        values.push_back(size == 1   ? *bytes
                         : size == 2 ? read_as<std::uint16_t>(bytes)
                                     : read_as<std::uint32_t>(bytes));
    }
    return values;
}

} // namespace renderer::scene
