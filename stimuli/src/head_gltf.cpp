// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stimuli/head.h>

#include <cstring>
#include <sstream>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <tiny_gltf.h>

#include <support/error.h>
#include <support/file.h>

#include "head_thickness.h"

namespace stimuli {
namespace {

using renderer::scene::Image;
using renderer::scene::Mesh;
using renderer::scene::Model;
using renderer::scene::Vertex;

constexpr double metres = 1e-3;             // a millimetre
constexpr double index_of_refraction = 1.4; // reflects 0.028 of light that falls straight on it

std::vector<unsigned char> png(const Image& image, const std::string& name) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create("memory.png", &memory);
    OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
    spec["oiio:UnassociatedAlpha"] = 1; // else colours would be divided by alpha
    if (!output || !output->open("memory.png", spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, image.pixels.data()) || !output->close()) {
        throw support::failure("{}: cannot be encoded: {}", name,
                               output ? output->geterror() : OIIO::geterror());
    }
    return bytes;
}

/// Fills a glTF model from the front to the back of its one buffer.
class Writer {
public:
    Writer() { gltf_.buffers.emplace_back(); }

    void add_mesh(const Mesh& mesh) {
        std::vector<float> places, normals, tangents, uvs;
        for (const Vertex& vertex : mesh.vertices) {
            const glm::vec3 place = glm::dvec3(vertex.position_mm) * metres;
            places.insert(places.end(), {place.x, place.y, place.z});
            normals.insert(normals.end(), {vertex.normal.x, vertex.normal.y, vertex.normal.z});
            tangents.insert(tangents.end(),
                            {vertex.tangent.x, vertex.tangent.y, vertex.tangent.z, vertex.tangent.w});
            uvs.insert(uvs.end(), {vertex.uv.x, vertex.uv.y});
        }
        tinygltf::Primitive primitive;
        primitive.attributes["POSITION"] = add_floats(places, 3, TINYGLTF_TYPE_VEC3);
        primitive.attributes["NORMAL"] = add_floats(normals, 3, TINYGLTF_TYPE_VEC3);
        primitive.attributes["TANGENT"] = add_floats(tangents, 4, TINYGLTF_TYPE_VEC4);
        primitive.attributes["TEXCOORD_0"] = add_floats(uvs, 2, TINYGLTF_TYPE_VEC2);
        primitive.indices =
            add_accessor(add_view(mesh.indices.data(), mesh.indices.size() * sizeof(std::uint32_t),
                                  TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER),
                         TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, mesh.indices.size(), TINYGLTF_TYPE_SCALAR);
        primitive.material = 0;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        tinygltf::Mesh written;
        written.name = "head";
        written.primitives.push_back(primitive);
        gltf_.meshes.push_back(written);
    }

    void add_skin(const renderer::scene::Material& skin, const Image& thickness) {
        tinygltf::Material written;
        written.name = skin.name;
        auto& pbr = written.pbrMetallicRoughness;
        pbr.baseColorTexture.index = add_texture(*skin.base_color, "albedo");
        pbr.metallicRoughnessTexture.index = add_texture(*skin.roughness, "reflection");
        pbr.metallicFactor = 0;
        pbr.roughnessFactor = static_cast<double>(skin.roughness_factor);
        written.normalTexture.index = add_texture(*skin.normal, "normal");

        using Object = tinygltf::Value::Object;
        const Object texture{{"index", tinygltf::Value(add_texture(thickness, "thickness"))}};
        const Object volume{
            {"thicknessFactor", tinygltf::Value(static_cast<double>(head::most_thickness_mm) * metres)},
            {"thicknessTexture", tinygltf::Value(texture)}};
        // The strength of the reflection is the roughness texture's alpha, which glTF leaves free.
        const Object reflection{{"index", tinygltf::Value(pbr.metallicRoughnessTexture.index)}};
        written.extensions["KHR_materials_specular"] =
            tinygltf::Value(Object{{"specularTexture", tinygltf::Value(reflection)}});
        written.extensions["KHR_materials_ior"] =
            tinygltf::Value(Object{{"ior", tinygltf::Value(index_of_refraction)}});
        // A volume counts only where light is transmitted; how much skin does is the renderer's to say.
        written.extensions["KHR_materials_transmission"] =
            tinygltf::Value(Object{{"transmissionFactor", tinygltf::Value(0.0)}});
        written.extensions["KHR_materials_volume"] = tinygltf::Value(volume);
        for (const auto& [name, value] : written.extensions) {
            gltf_.extensionsUsed.push_back(name);
        }
        gltf_.materials.push_back(written);
    }

    std::string finish(const std::string& name) {
        gltf_.asset.version = "2.0";
        gltf_.asset.generator = "skin2afc";
        tinygltf::Node node;
        node.name = name;
        node.mesh = 0;
        gltf_.nodes.push_back(node);
        tinygltf::Scene scene;
        scene.nodes.push_back(0);
        gltf_.scenes.push_back(scene);
        gltf_.defaultScene = 0;
        std::ostringstream stream;
        tinygltf::TinyGLTF writer;
        if (!writer.WriteGltfSceneToStream(&gltf_, stream, false, true)) {
            throw support::failure("{}: cannot be written as glTF", name);
        }
        return std::move(stream).str();
    }

private:
    int add_view(const void* data, std::size_t size, int target) {
        std::vector<unsigned char>& buffer = gltf_.buffers.front().data;
        buffer.resize((buffer.size() + 3) / 4 * 4); // views of floats start at multiples of four bytes
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = buffer.size();
        view.byteLength = size;
        view.target = target;
        const auto* bytes = static_cast<const unsigned char*>(data);
        buffer.insert(buffer.end(), bytes, bytes + size);
        gltf_.bufferViews.push_back(view);
        return static_cast<int>(gltf_.bufferViews.size()) - 1;
    }

    int add_accessor(int view, int component, std::size_t count, int type) {
        tinygltf::Accessor accessor;
        accessor.bufferView = view;
        accessor.componentType = component;
        accessor.count = count;
        accessor.type = type;
        gltf_.accessors.push_back(accessor);
        return static_cast<int>(gltf_.accessors.size()) - 1;
    }

    int add_floats(const std::vector<float>& values, std::size_t width, int type) {
        const int index =
            add_accessor(add_view(values.data(), values.size() * sizeof(float), TINYGLTF_TARGET_ARRAY_BUFFER),
                         TINYGLTF_COMPONENT_TYPE_FLOAT, values.size() / width, type);
        tinygltf::Accessor& accessor = gltf_.accessors.back();
        for (std::size_t k = 0; k < width; ++k) {
            float low = values[k], high = low;
            for (std::size_t i = k; i < values.size(); i += width) {
                low = std::min(low, values[i]);
                high = std::max(high, values[i]);
            }
            accessor.minValues.push_back(static_cast<double>(low));
            accessor.maxValues.push_back(static_cast<double>(high));
        }
        return index;
    }

    int add_texture(const Image& pixels, const std::string& name) {
        if (gltf_.samplers.empty()) {
            tinygltf::Sampler sampler; // around the seam u wraps; the poles do not meet
            sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
            sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
            sampler.wrapS = TINYGLTF_TEXTURE_WRAP_REPEAT;
            sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
            gltf_.samplers.push_back(sampler);
        }
        const std::vector<unsigned char> bytes = png(pixels, name);
        tinygltf::Image image;
        image.name = name;
        image.mimeType = "image/png";
        image.bufferView = add_view(bytes.data(), bytes.size(), 0);
        gltf_.images.push_back(image);
        tinygltf::Texture texture;
        texture.source = static_cast<int>(gltf_.images.size()) - 1;
        texture.sampler = 0;
        gltf_.textures.push_back(texture);
        return static_cast<int>(gltf_.textures.size()) - 1;
    }

    tinygltf::Model gltf_;
};

} // namespace

void write_head(const Model& head, const std::filesystem::path& file) {
    Writer writer;
    writer.add_mesh(head.meshes.front());
    writer.add_skin(head.materials.front(), head::thickness_map(head.meshes.front()));
    support::write_atomically(file, writer.finish(head.name));
}

} // namespace stimuli
