// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "gltf_material.h"

#include <cmath>
#include <map>

#include <renderer/scene/image_file.h>
#include <support/error.h>

namespace renderer::scene {
namespace {

namespace fs = std::filesystem;

constexpr double largest_normal_scale = 100;

class MaterialReader {
public:
    MaterialReader(const tinygltf::Model& source, const AccessorReader& reader, const fs::path& file,
                   const ModelOverrides& overrides)
        : source_(source), reader_(reader), file_(file), overrides_(overrides) {}

    std::vector<Material> convert() {
        std::vector<Material> materials;
        const auto own = [](const std::optional<fs::path>& path) {
            return path ? read_image(*path) : nullptr;
        };
        const ImagePtr base_color = own(overrides_.base_color);
        const ImagePtr normal = own(overrides_.normal);
        const ImagePtr roughness = own(overrides_.roughness);
        for (std::size_t i = 0; i <= source_.materials.size(); ++i) {
            Material material;
            if (i < source_.materials.size()) {
                material = convert_material(source_.materials[i], fmt::format("materials[{}]", i));
            }
            if (base_color) {
                // The factor belongs to the picture that is replaced.
                material.base_color = base_color;
                material.base_color_factor = glm::vec3(1);
            }
            if (normal) {
                material.normal = normal;
                material.normal_scale = 1;
            }
            if (roughness) {
                material.roughness = roughness;
                material.roughness_factor = 1;
            }
            materials.push_back(std::move(material));
        }
        return materials;
    }

private:
    ImagePtr texture(int index, const std::string& what) {
        if (index < 0) {
            return nullptr;
        }
        if (static_cast<std::size_t>(index) >= source_.textures.size()) {
            throw support::input_error("{}: {}: expected a texture below {}, found {}", file_.string(), what,
                                       source_.textures.size(), index);
        }
        const int source = source_.textures[static_cast<std::size_t>(index)].source;
        if (source < 0 || static_cast<std::size_t>(source) >= source_.images.size()) {
            throw support::input_error("{}: textures[{}].source: expected an image below {}, found {}",
                                       file_.string(), index, source_.images.size(), source);
        }
        ImagePtr& decoded = images_[source];
        if (!decoded) {
            const tinygltf::Image& image = source_.images[static_cast<std::size_t>(source)];
            const std::string name = fmt::format("{}: images[{}]", file_.string(), source);
            const std::vector<std::uint8_t> bytes =
                image.bufferView >= 0
                    ? reader_.view_bytes(image.bufferView, fmt::format("images[{}]", source))
                    : std::vector<std::uint8_t>(image.image);
            if (bytes.empty()) {
                throw support::input_error("{}: expected the file {}, found none", name,
                                           support::one_line(image.uri));
            }
            decoded = decode_image(bytes, name);
        }
        return decoded;
    }

    Material convert_material(const tinygltf::Material& source, const std::string& what) {
        const auto& pbr = source.pbrMetallicRoughness;
        Material material;
        material.name = source.name;
        material.double_sided = source.doubleSided;
        const bool textured[] = {pbr.baseColorTexture.texCoord != 0, source.normalTexture.texCoord != 0,
                                 pbr.metallicRoughnessTexture.texCoord != 0};
        if (textured[0] || textured[1] || textured[2]) {
            throw texture_coordinates_error(what);
        }
        if (!(std::abs(source.normalTexture.scale) <= largest_normal_scale)) {
            throw support::input_error("{}: {}.normalTexture.scale: expected -{} to {}, found {}",
                                       file_.string(), what, largest_normal_scale, largest_normal_scale,
                                       source.normalTexture.scale);
        }
        material.normal_scale = static_cast<float>(source.normalTexture.scale);
        if (!overrides_.base_color) {
            material.base_color = texture(pbr.baseColorTexture.index, what + ".baseColorTexture");
        }
        if (!overrides_.normal) {
            material.normal = texture(source.normalTexture.index, what + ".normalTexture");
        }
        if (!overrides_.roughness) {
            material.roughness =
                texture(pbr.metallicRoughnessTexture.index, what + ".metallicRoughnessTexture");
        }
        if (pbr.baseColorFactor.size() == 4) {
            for (int c = 0; c < 3; ++c) {
                const double factor = pbr.baseColorFactor[static_cast<std::size_t>(c)];
                if (!(factor >= 0 && factor <= 1)) {
                    throw support::input_error("{}: {}.baseColorFactor: expected 0 to 1, found {}",
                                               file_.string(), what, factor);
                }
                material.base_color_factor[c] = static_cast<float>(factor);
            }
        }
        // A file without any word on roughness leaves it to the protocol; tinygltf fills in 1.
        if (material.roughness || pbr.roughnessFactor != 1.0) {
            if (!(pbr.roughnessFactor >= 0 && pbr.roughnessFactor <= 1)) {
                throw support::input_error("{}: {}.roughnessFactor: expected 0 to 1, found {}",
                                           file_.string(), what, pbr.roughnessFactor);
            }
            material.roughness_factor = static_cast<float>(pbr.roughnessFactor);
        }
        const auto specular = source.extensions.find(specular_extension);
        if (specular != source.extensions.end()) {
            read_specular(specular->second, fmt::format("{}.{}", what, specular_extension), material);
        }
        return material;
    }

    /// How strong the reflection is; its colour is white on skin, whatever the file says.
    void read_specular(const tinygltf::Value& extension, const std::string& what, Material& material) {
        if (extension.Has("specularFactor")) {
            const tinygltf::Value& factor = extension.Get("specularFactor");
            const double value = factor.IsNumber() ? factor.GetNumberAsDouble() : -1;
            if (!(value >= 0 && value <= 1)) {
                throw support::input_error("{}: {}.specularFactor: expected 0 to 1, found {}", file_.string(),
                                           what, factor.IsNumber() ? fmt::to_string(value) : "no number");
            }
            material.specular_factor = static_cast<float>(value);
        }
        if (extension.Has("specularTexture")) {
            const tinygltf::Value& found = extension.Get("specularTexture");
            const bool has_index = found.Has("index") && found.Get("index").IsInt();
            if (!has_index || found.Get("index").GetNumberAsInt() < 0) {
                throw support::input_error("{}: {}.specularTexture.index: expected a whole number from 0 on",
                                           file_.string(), what);
            }
            const bool has_set = found.Has("texCoord");
            if (has_set && (!found.Get("texCoord").IsInt() || found.Get("texCoord").GetNumberAsInt() != 0)) {
                throw texture_coordinates_error(what);
            }
            material.specular = texture(found.Get("index").GetNumberAsInt(), what + ".specularTexture");
        }
    }

    support::InputError texture_coordinates_error(const std::string& what) const {
        return support::input_error(
            "{}: {}: expected textures on TEXCOORD_0, found another texCoord (not supported)", file_.string(),
            what);
    }

    const tinygltf::Model& source_;
    const AccessorReader& reader_;
    const fs::path& file_;
    const ModelOverrides& overrides_;
    std::map<int, ImagePtr> images_; // decoded once, however many textures show them
};

} // namespace

std::vector<Material> read_materials(const tinygltf::Model& source, const AccessorReader& reader,
                                     const fs::path& file, const ModelOverrides& overrides) {
    return MaterialReader(source, reader, file, overrides).convert();
}

} // namespace renderer::scene
