// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <renderer/scene/gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <string_view>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <support/error.h>
#include <support/file.h>
#include <support/json_depth.h>

#include "gltf_accessor.h"
#include "gltf_material.h"

namespace renderer::scene {
namespace {

namespace fs = std::filesystem;

// Deeper trees of nodes are taken for an attack; real models have a few levels.
constexpr int deepest_node = 128;

/// Keep an image file's encoded bytes; those inside buffer views are fetched later, with their bounds
/// checked.
bool keep_encoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                  const unsigned char* bytes, int size, void*) {
    if (image->bufferView < 0 && bytes && size > 0) {
        image->image.assign(bytes, bytes + size);
    }
    return true;
}

tinygltf::Model parse(const fs::path& file) {
    const std::vector<std::uint8_t> bytes = support::read_bytes(file, std::uintmax_t{2} << 30);
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(&keep_encoded, nullptr);
    tinygltf::Model model;
    std::string error;
    std::string warning;
    const std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
    const bool binary =
        bytes.size() >= 4 && bytes[0] == 'g' && bytes[1] == 'l' && bytes[2] == 'T' && bytes[3] == 'F';
    // A binary file holds its JSON after a header of 12 and a chunk header of 8 bytes; what follows it is no
    // text.
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    std::uint32_t json_size = 0;
    if (binary && bytes.size() >= 20) {
        std::memcpy(&json_size, &bytes[12], sizeof json_size);
    }
    support::check_json_depth(binary ? text.substr(std::min<std::size_t>(20, text.size()), json_size) : text,
                              file.string());
    bool ok = false;
    try {
        const auto size = static_cast<unsigned int>(bytes.size());
        ok = binary ? loader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(), size, folder)
                    : loader.LoadASCIIFromString(&model, &error, &warning,
                                                 reinterpret_cast<const char*>(bytes.data()), size, folder);
    } catch (const std::exception& exception) {
        error = exception.what();
    }
    if (!ok) {
        throw support::input_error("{}: expected a glTF 2.0 model, found: {}", file.string(),
                                   error.empty() ? "nothing that could be read" : support::one_line(error));
    }
    for (const std::string& extension : model.extensionsRequired) {
        if (extension != specular_extension) {
            throw support::input_error(
                "{}: extensionsRequired: expected none but {}, found {} (not supported)", file.string(),
                specular_extension, support::one_line(extension));
        }
    }
    return model;
}

/// Converts one parsed file.
class Converter {
public:
    Converter(const tinygltf::Model& source, const fs::path& file, const ModelOverrides& overrides)
        : source_(source), file_(file), overrides_(overrides), reader_(source, file.string()) {}

    Model convert() {
        result_.name = file_.filename().string();
        result_.materials = read_materials(source_, reader_, file_, overrides_);
        for (const int root : root_nodes()) {
            visit(root, glm::dmat4(1), 0);
        }
        if (result_.meshes.empty()) {
            throw support::input_error("{}: expected triangles in the default scene, found none",
                                       file_.string());
        }
        const Bounds extent = bounds(result_);
        if (!(glm::length(extent.high - extent.low) > 1e-3f)) { // millimetres
            throw support::input_error("{}: expected a model of some extent, found all of it at one place",
                                       file_.string());
        }
        result_.digest = content_digest(result_);
        return std::move(result_);
    }

private:
    std::vector<int> root_nodes() const {
        if (source_.scenes.empty()) {
            // Without scenes every node that is nobody's child is a root.
            std::set<int> children;
            for (const auto& node : source_.nodes) {
                children.insert(node.children.begin(), node.children.end());
            }
            std::vector<int> roots;
            for (int i = 0; i < static_cast<int>(source_.nodes.size()); ++i) {
                if (!children.contains(i)) {
                    roots.push_back(i);
                }
            }
            return roots;
        }
        const std::size_t scene =
            source_.defaultScene < 0 ? 0 : static_cast<std::size_t>(source_.defaultScene);
        if (scene >= source_.scenes.size()) {
            throw support::input_error("{}: scene: expected a number below {}, found {}", file_.string(),
                                       source_.scenes.size(), scene);
        }
        return source_.scenes[scene].nodes;
    }

    static glm::dmat4 local_transform(const tinygltf::Node& node) {
        if (node.matrix.size() == 16) {
            return glm::make_mat4(node.matrix.data());
        }
        glm::dmat4 transform(1);
        if (node.translation.size() == 3) {
            transform = glm::translate(transform, glm::make_vec3(node.translation.data()));
        }
        if (node.rotation.size() == 4) {
            const auto& q = node.rotation; // x, y, z, w
            transform *= glm::mat4_cast(glm::normalize(glm::dquat(q[3], q[0], q[1], q[2])));
        }
        if (node.scale.size() == 3) {
            transform = glm::scale(transform, glm::make_vec3(node.scale.data()));
        }
        return transform;
    }

    void visit(int index, const glm::dmat4& parent, int depth) {
        if (index < 0 || static_cast<std::size_t>(index) >= source_.nodes.size() || depth > deepest_node) {
            throw support::input_error("{}: nodes: expected a tree of {} nodes, found node {} at depth {}",
                                       file_.string(), source_.nodes.size(), index, depth);
        }
        if (!visited_.insert(index).second) {
            throw support::input_error("{}: nodes: expected each node once, found node {} with two parents",
                                       file_.string(), index);
        }
        const tinygltf::Node& node = source_.nodes[static_cast<std::size_t>(index)];
        const glm::dmat4 transform = parent * local_transform(node);
        if (node.mesh >= 0) {
            if (static_cast<std::size_t>(node.mesh) >= source_.meshes.size()) {
                throw support::input_error("{}: nodes[{}].mesh: expected a number below {}, found {}",
                                           file_.string(), index, source_.meshes.size(), node.mesh);
            }
            const auto& mesh = source_.meshes[static_cast<std::size_t>(node.mesh)];
            for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
                convert_primitive(mesh.primitives[i], transform,
                                  fmt::format("meshes[{}].primitives[{}]", node.mesh, i));
            }
        }
        for (const int child : node.children) {
            visit(child, transform, depth + 1);
        }
    }

    /// Triangle corners from a list, strip or fan; other modes are no surface.
    std::vector<std::uint32_t> triangle_corners(const tinygltf::Primitive& primitive, std::size_t vertices,
                                                const std::string& what) const {
        std::vector<std::uint32_t> list;
        if (primitive.indices >= 0) {
            list = reader_.indices(primitive.indices, what + ".indices");
        } else {
            for (std::uint32_t i = 0; i < vertices; ++i) {
                list.push_back(i);
            }
        }
        for (std::size_t i = 0; i < list.size(); ++i) {
            if (list[i] >= vertices) {
                throw support::input_error(
                    "{}: {}.indices: expected numbers below {} (vertices), found {} at {}", file_.string(),
                    what, vertices, list[i], i);
            }
        }
        if (primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode == -1) {
            if (list.size() % 3 != 0) {
                throw support::input_error("{}: {}.indices: expected three a triangle, found {}",
                                           file_.string(), what, list.size());
            }
            return list;
        }
        std::vector<std::uint32_t> corners;
        for (std::size_t i = 2; i < list.size(); ++i) {
            if (primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN) {
                corners.insert(corners.end(), {list[0], list[i - 1], list[i]});
            } else if (i % 2 == 0) {
                corners.insert(corners.end(), {list[i - 2], list[i - 1], list[i]});
            } else {
                corners.insert(corners.end(), {list[i - 1], list[i - 2], list[i]});
            }
        }
        return corners;
    }

    void convert_primitive(const tinygltf::Primitive& primitive, const glm::dmat4& transform,
                           const std::string& what) {
        const bool surface = primitive.mode == -1 || primitive.mode == TINYGLTF_MODE_TRIANGLES ||
                             primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
                             primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
        if (!surface) {
            return;
        }
        const auto attribute = [&](const char* name, int components, std::size_t count) {
            const auto found = primitive.attributes.find(name);
            const std::string field = fmt::format("{}.{}", what, name);
            if (found == primitive.attributes.end()) {
                return std::vector<float>{};
            }
            std::vector<float> values = reader_.floats(found->second, components, field);
            if (count > 0 && values.size() != count * static_cast<std::size_t>(components)) {
                throw support::input_error("{}: {}: expected {} elements as POSITION has, found {}",
                                           file_.string(), field, count,
                                           values.size() / static_cast<std::size_t>(components));
            }
            return values;
        };
        const std::vector<float> positions = attribute("POSITION", 3, 0);
        if (positions.empty()) {
            throw support::input_error("{}: {}: expected POSITION, found none", file_.string(), what);
        }
        const std::size_t count = positions.size() / 3;
        const std::vector<float> normals = attribute("NORMAL", 3, count);
        const std::vector<float> tangents = attribute("TANGENT", 4, count);
        const std::vector<float> uvs = attribute("TEXCOORD_0", 2, count);

        Mesh mesh;
        mesh.has_uv = !uvs.empty();
        mesh.material = material_index(primitive.material, what);
        mesh.indices = triangle_corners(primitive, count, what);
        const glm::dmat3 linear(transform);
        const double millimetres = 1000 * overrides_.metres_per_unit;
        const bool mirrored = glm::determinant(linear) < 0;
        const glm::dmat3 normal_matrix = glm::transpose(glm::inverse(linear));
        bool zero_normal = normals.empty();
        for (std::size_t i = 0; i < count; ++i) {
            Vertex vertex;
            const glm::dvec4 p(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2], 1);
            vertex.position_mm = glm::vec3(glm::dvec3(transform * p) * millimetres);
            if (glm::any(glm::isnan(vertex.position_mm)) || glm::any(glm::isinf(vertex.position_mm))) {
                throw support::input_error(
                    "{}: {}: expected finite places after the node transforms, found none at "
                    "vertex {}",
                    file_.string(), what, i);
            }
            if (!normals.empty()) {
                const glm::dvec3 n =
                    normal_matrix * glm::dvec3(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]);
                const double length = glm::length(n);
                zero_normal = zero_normal || !(length > 0) || !std::isfinite(length);
                vertex.normal = glm::vec3(n / length);
            }
            if (mesh.has_uv) {
                vertex.uv = {uvs[2 * i], overrides_.flip_v ? 1 - uvs[2 * i + 1] : uvs[2 * i + 1]};
            }
            if (!tangents.empty()) {
                const glm::dvec3 t =
                    linear * glm::dvec3(tangents[4 * i], tangents[4 * i + 1], tangents[4 * i + 2]);
                vertex.tangent = glm::vec4(glm::vec3(t), tangents[4 * i + 3] < 0 ? -1.0f : 1.0f);
            }
            mesh.vertices.push_back(vertex);
        }
        if (mirrored) {
            for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
                std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
            }
        }
        if (zero_normal) {
            compute_normals(mesh);
        }
        // Tangents of a flipped or mirrored surface change their handedness, so they are made anew.
        if (tangents.empty() || overrides_.flip_v || mirrored || !make_orthonormal(mesh)) {
            compute_tangents(mesh);
        }
        if (!mesh.indices.empty()) {
            result_.meshes.push_back(std::move(mesh));
        }
    }

    /// Make the file's tangents unit length and orthogonal to the normals; false if one cannot be.
    static bool make_orthonormal(Mesh& mesh) {
        for (Vertex& vertex : mesh.vertices) {
            const glm::vec3 t(vertex.tangent);
            const glm::vec3 flat = t - vertex.normal * glm::dot(vertex.normal, t);
            const float length = glm::length(flat);
            if (!(length > 1e-6f) || !std::isfinite(length)) {
                return false;
            }
            vertex.tangent = glm::vec4(flat / length, vertex.tangent.w);
        }
        return true;
    }

    std::size_t material_index(int material, const std::string& what) const {
        if (material < 0) {
            return source_.materials.size(); // glTF's default material comes last
        }
        if (static_cast<std::size_t>(material) >= source_.materials.size()) {
            throw support::input_error("{}: {}.material: expected a number below {}, found {}",
                                       file_.string(), what, source_.materials.size(), material);
        }
        return static_cast<std::size_t>(material);
    }

    const tinygltf::Model& source_;
    fs::path file_;
    ModelOverrides overrides_;
    AccessorReader reader_;
    Model result_;
    std::set<int> visited_;
};

} // namespace

Model load_gltf(const fs::path& file, const ModelOverrides& overrides) {
    const tinygltf::Model parsed = parse(file);
    return Converter(parsed, file, overrides).convert();
}

} // namespace renderer::scene
