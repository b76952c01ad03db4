// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <renderer/scene/model.h>

#include <support/file.h>

namespace renderer::scene {
namespace {

template <typename T>
void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <typename T>
void append_all(std::string& bytes, const std::vector<T>& values) {
    append(bytes, values.size());
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

void append_image(std::string& bytes, const ImagePtr& image) {
    append(bytes, image ? image->width : 0);
    if (image) {
        append(bytes, image->channels);
        append_all(bytes, image->pixels);
    }
}

} // namespace

std::string content_digest(const Model& model) {
    // Vertex is all floats without padding, so its bytes are its value.
    static_assert(sizeof(Vertex) == 12 * sizeof(float));
    std::string digests;
    for (const Material& material : model.materials) {
        std::string bytes;
        append_image(bytes, material.base_color);
        append_image(bytes, material.normal);
        append_image(bytes, material.roughness);
        append_image(bytes, material.specular);
        append(bytes, material.base_color_factor);
        append(bytes, material.normal_scale);
        append(bytes, material.roughness_factor);
        append(bytes, material.specular_factor);
        append(bytes, material.double_sided);
        digests += support::sha256(bytes);
    }
    for (const Mesh& mesh : model.meshes) {
        std::string bytes;
        append_all(bytes, mesh.vertices);
        append_all(bytes, mesh.indices);
        append(bytes, mesh.material);
        append(bytes, mesh.has_uv);
        digests += support::sha256(bytes);
    }
    return support::sha256(digests);
}

} // namespace renderer::scene
