// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <renderer/gl/objects.h>

#include <glm/gtc/type_ptr.hpp>

#include <support/error.h>

namespace renderer::gl {

void delete_texture(GLuint id) { glDeleteTextures(1, &id); }
void delete_sampler(GLuint id) { glDeleteSamplers(1, &id); }
void delete_framebuffer(GLuint id) { glDeleteFramebuffers(1, &id); }
void delete_buffer(GLuint id) { glDeleteBuffers(1, &id); }
void delete_vertex_array(GLuint id) { glDeleteVertexArrays(1, &id); }
void delete_shader(GLuint id) { glDeleteShader(id); }
void delete_program(GLuint id) { glDeleteProgram(id); }

namespace {

GLuint created(void (*create)(GLsizei, GLuint*)) {
    GLuint id = 0;
    create(1, &id);
    return id;
}

GLuint created_texture(GLenum target) {
    GLuint id = 0;
    glCreateTextures(target, 1, &id);
    return id;
}

std::string shader_log(GLuint shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    glGetShaderInfoLog(shader, length, nullptr, log.data());
    return log;
}

std::string program_log(GLuint program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    glGetProgramInfoLog(program, length, nullptr, log.data());
    return log;
}

const char* stage_word(GLenum kind) {
    switch (kind) {
    case GL_VERTEX_SHADER:
        return "vertex";
    case GL_GEOMETRY_SHADER:
        return "geometry";
    case GL_FRAGMENT_SHADER:
        return "fragment";
    default:
        return "compute";
    }
}

} // namespace

Texture::Texture(GLenum internal_format, int width, int height, int levels, int samples)
    : width_(width), height_(height) {
    if (samples > 1) {
        handle_ = Handle<delete_texture>(created_texture(GL_TEXTURE_2D_MULTISAMPLE));
        glTextureStorage2DMultisample(id(), samples, internal_format, width, height, GL_TRUE);
    } else {
        handle_ = Handle<delete_texture>(created_texture(GL_TEXTURE_2D));
        glTextureStorage2D(id(), levels, internal_format, width, height);
        filter(GL_NEAREST, GL_NEAREST);
    }
}

Texture Texture::array(GLenum internal_format, int width, int height, int layers) {
    Texture texture;
    texture.width_ = width;
    texture.height_ = height;
    texture.layers_ = layers;
    texture.handle_ = Handle<delete_texture>(created_texture(GL_TEXTURE_2D_ARRAY));
    glTextureStorage3D(texture.id(), 1, internal_format, width, height, layers);
    texture.filter(GL_NEAREST, GL_NEAREST);
    return texture;
}

void Texture::upload(GLenum format, GLenum type, const void* pixels) {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(id(), 0, 0, 0, width_, height_, format, type, pixels);
}

void Texture::filter(GLint minify, GLint magnify, GLint wrap) {
    glTextureParameteri(id(), GL_TEXTURE_MIN_FILTER, minify);
    glTextureParameteri(id(), GL_TEXTURE_MAG_FILTER, magnify);
    glTextureParameteri(id(), GL_TEXTURE_WRAP_S, wrap);
    glTextureParameteri(id(), GL_TEXTURE_WRAP_T, wrap);
}

void Texture::generate_mipmaps() { glGenerateTextureMipmap(id()); }

Sampler::Sampler(GLint filter, GLint wrap) {
    GLuint id = 0;
    glCreateSamplers(1, &id);
    handle_ = Handle<delete_sampler>(id);
    glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, filter);
    glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, filter);
    glSamplerParameteri(id, GL_TEXTURE_WRAP_S, wrap);
    glSamplerParameteri(id, GL_TEXTURE_WRAP_T, wrap);
}

Framebuffer::Framebuffer(std::initializer_list<const Texture*> colors, const Texture* depth)
    : Framebuffer(std::vector<const Texture*>(colors), depth) {}

Framebuffer::Framebuffer(const std::vector<const Texture*>& colors, const Texture* depth)
    : handle_(created(glCreateFramebuffers)) {
    std::vector<GLenum> buffers;
    for (const Texture* color : colors) {
        const auto attachment = static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + buffers.size());
        glNamedFramebufferTexture(id(), attachment, color->id(), 0);
        buffers.push_back(attachment);
    }
    finish(buffers, colors.empty() ? *depth : **colors.begin(), depth);
}

Framebuffer::Framebuffer(const Texture& color, int layer, const Texture* depth)
    : handle_(created(glCreateFramebuffers)) {
    glNamedFramebufferTextureLayer(id(), GL_COLOR_ATTACHMENT0, color.id(), 0, layer);
    finish({GL_COLOR_ATTACHMENT0}, color, depth);
}

void Framebuffer::finish(const std::vector<GLenum>& buffers, const Texture& first, const Texture* depth) {
    if (depth) {
        glNamedFramebufferTexture(id(), GL_DEPTH_ATTACHMENT, depth->id(), 0);
    }
    glNamedFramebufferDrawBuffers(id(), static_cast<GLsizei>(buffers.size()), buffers.data());
    width_ = first.width();
    height_ = first.height();
    const GLenum status = glCheckNamedFramebufferStatus(id(), GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        throw support::failure("a framebuffer of {}x{} with {} colour targets is not complete: 0x{:x}",
                               width_, height_, buffers.size(), status);
    }
}

void Framebuffer::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, id());
    glViewport(0, 0, width_, height_);
}

void Framebuffer::clear_color(int attachment, const glm::vec4& value) const {
    glClearNamedFramebufferfv(id(), GL_COLOR, attachment, glm::value_ptr(value));
}

void Framebuffer::clear_color(int attachment, const glm::uvec4& value) const {
    glClearNamedFramebufferuiv(id(), GL_COLOR, attachment, glm::value_ptr(value));
}

void Framebuffer::clear_depth(float value) const { glClearNamedFramebufferfv(id(), GL_DEPTH, 0, &value); }

Buffer::Buffer(const void* data, std::size_t bytes) : handle_(created(glCreateBuffers)) {
    glNamedBufferStorage(id(), static_cast<GLsizeiptr>(bytes), data, 0);
}

VertexArray::VertexArray() : handle_(created(glCreateVertexArrays)) {}

Program::Program(const std::vector<Stage>& stages) : handle_(glCreateProgram()) {
    std::string names;
    for (const Stage& stage : stages) {
        const Handle<delete_shader> shader(glCreateShader(stage.kind));
        const char* source = stage.source.c_str();
        glShaderSource(shader.id(), 1, &source, nullptr);
        glCompileShader(shader.id());
        GLint ok = 0;
        glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &ok);
        if (ok == GL_FALSE) {
            throw support::failure("{} ({} stage): {}", stage.name, stage_word(stage.kind),
                                   support::one_line(shader_log(shader.id())));
        }
        glAttachShader(id(), shader.id());
        names += (names.empty() ? "" : " + ") + stage.name;
    }
    glLinkProgram(id());
    GLint ok = 0;
    glGetProgramiv(id(), GL_LINK_STATUS, &ok);
    if (ok == GL_FALSE) {
        throw support::failure("{}: does not link: {}", names, support::one_line(program_log(id())));
    }
}

void Program::set(const char* name, int value) const { glProgramUniform1i(id(), location(name), value); }
void Program::set(const char* name, float value) const { glProgramUniform1f(id(), location(name), value); }
void Program::set(const char* name, const glm::ivec2& value) const {
    glProgramUniform2iv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::vec2& value) const {
    glProgramUniform2fv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::vec3& value) const {
    glProgramUniform3fv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::mat3& value) const {
    glProgramUniformMatrix3fv(id(), location(name), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::mat4& value) const {
    glProgramUniformMatrix4fv(id(), location(name), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(const char* name, const std::vector<float>& values) const {
    glProgramUniform1fv(id(), location(name), static_cast<GLsizei>(values.size()), values.data());
}
void Program::set(const char* name, const std::vector<glm::vec2>& values) const {
    glProgramUniform2fv(id(), location(name), static_cast<GLsizei>(values.size()),
                        reinterpret_cast<const float*>(values.data()));
}
void Program::set(const char* name, const std::vector<glm::vec3>& values) const {
    glProgramUniform3fv(id(), location(name), static_cast<GLsizei>(values.size()),
                        reinterpret_cast<const float*>(values.data()));
}

void Program::set(const char* name, const std::vector<glm::mat4>& values) const {
    glProgramUniformMatrix4fv(id(), location(name), static_cast<GLsizei>(values.size()), GL_FALSE,
                              reinterpret_cast<const float*>(values.data()));
}
void Program::set(const char* name, const std::vector<int>& values) const {
    glProgramUniform1iv(id(), location(name), static_cast<GLsizei>(values.size()), values.data());
}

} // namespace renderer::gl
