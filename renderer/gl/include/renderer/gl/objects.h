// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include <epoxy/gl.h>
#include <glm/glm.hpp>

namespace renderer::gl {

/// The name of an OpenGL object, deleted with its owner. Needs the context that made it to be current.
template <void (*Delete)(GLuint)>
class Handle {
public:
    Handle() = default;
    explicit Handle(GLuint id) : id_(id) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~Handle() {
        if (id_ != 0) {
            Delete(id_);
        }
    }
    GLuint id() const { return id_; }

private:
    GLuint id_ = 0;
};

void delete_texture(GLuint id);
void delete_sampler(GLuint id);
void delete_framebuffer(GLuint id);
void delete_buffer(GLuint id);
void delete_vertex_array(GLuint id);
void delete_shader(GLuint id);
void delete_program(GLuint id);

/// A 2D texture with immutable storage; `samples` > 1 makes it multisampled.
class Texture {
public:
    Texture() = default;
    Texture(GLenum internal_format, int width, int height, int levels = 1, int samples = 1);
    /// Layers of one size, which a shader reads as a sampler2DArray.
    static Texture array(GLenum internal_format, int width, int height, int layers);

    GLuint id() const { return handle_.id(); }
    int width() const { return width_; }
    int height() const { return height_; }
    int layers() const { return layers_; }
    /// Copy pixels into level 0; rows are tightly packed, the first is texture row 0.
    void upload(GLenum format, GLenum type, const void* pixels);
    /// Filters and wrap mode; the defaults are nearest and clamp to edge.
    void filter(GLint minify, GLint magnify, GLint wrap = GL_CLAMP_TO_EDGE);
    void generate_mipmaps();
    void bind(GLuint unit) const { glBindTextureUnit(unit, id()); }

private:
    Handle<delete_texture> handle_;
    int width_ = 0, height_ = 0, layers_ = 1;
};

/// How a texture unit reads: takes the place of the texture's own filter and wrap mode while bound.
class Sampler {
public:
    Sampler(GLint filter, GLint wrap);
    void bind(GLuint unit) const { glBindSampler(unit, handle_.id()); }
    static void unbind(GLuint unit) { glBindSampler(unit, 0); }

private:
    Handle<delete_sampler> handle_;
};

/// A framebuffer over textures that outlive it; complete, or the constructor throws support::Failure.
class Framebuffer {
public:
    Framebuffer() = default;
    explicit Framebuffer(std::initializer_list<const Texture*> colors, const Texture* depth = nullptr);
    explicit Framebuffer(const std::vector<const Texture*>& colors, const Texture* depth = nullptr);
    /// Over one layer of an array.
    Framebuffer(const Texture& color, int layer, const Texture* depth = nullptr);

    GLuint id() const { return handle_.id(); }
    /// Bind it for drawing, with the viewport over all of it.
    void bind() const;
    void clear_color(int attachment, const glm::vec4& value) const;
    void clear_color(int attachment, const glm::uvec4& value) const;
    void clear_depth(float value) const;

private:
    void finish(const std::vector<GLenum>& buffers, const Texture& first, const Texture* depth);

    Handle<delete_framebuffer> handle_;
    int width_ = 0, height_ = 0;
};

/// An immutable buffer.
class Buffer {
public:
    Buffer() = default;
    Buffer(const void* data, std::size_t bytes);
    GLuint id() const { return handle_.id(); }

private:
    Handle<delete_buffer> handle_;
};

/// A vertex array; filled by its owner.
class VertexArray {
public:
    VertexArray();
    GLuint id() const { return handle_.id(); }

private:
    Handle<delete_vertex_array> handle_;
};

/// Source text of one stage, with the name that errors show.
struct Stage {
    GLenum kind;
    std::string name, source;
};

/// A linked program. A compile or link error throws support::Failure that names file, stage and line.
class Program {
public:
    Program() = default;
    explicit Program(const std::vector<Stage>& stages);

    void use() const { glUseProgram(handle_.id()); }
    GLuint id() const { return handle_.id(); }
    /// Set a uniform; one that the linker dropped is ignored.
    void set(const char* name, int value) const;
    void set(const char* name, float value) const;
    void set(const char* name, const glm::ivec2& value) const;
    void set(const char* name, const glm::vec2& value) const;
    void set(const char* name, const glm::vec3& value) const;
    void set(const char* name, const glm::mat3& value) const;
    void set(const char* name, const glm::mat4& value) const;
    void set(const char* name, const std::vector<float>& values) const;
    void set(const char* name, const std::vector<glm::vec2>& values) const;
    void set(const char* name, const std::vector<glm::vec3>& values) const;
    void set(const char* name, const std::vector<glm::mat4>& values) const;
    void set(const char* name, const std::vector<int>& values) const;

private:
    GLint location(const char* name) const { return glGetUniformLocation(id(), name); }
    Handle<delete_program> handle_;
};

} // namespace renderer::gl
