// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <renderer/gl/context.h>

#include <cstring>
#include <string_view>
#include <vector>

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <support/error.h>

namespace renderer::gl {

struct Context::Egl {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;

    ~Egl() {
        if (display != EGL_NO_DISPLAY) {
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
            if (context != EGL_NO_CONTEXT) {
                eglDestroyContext(display, context);
            }
            eglTerminate(display);
        }
    }
};

namespace {

bool has_extension(const char* list, std::string_view name) {
    std::string_view rest = list ? list : "";
    while (!rest.empty()) {
        const std::size_t end = rest.find(' ');
        if (rest.substr(0, end) == name) {
            return true;
        }
        rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    }
    return false;
}

/// A display to try, with the words that name it in errors.
struct Candidate {
    std::string name;
    EGLDisplay display;
};

/// Displays in the order to try them: hardware devices, the surfaceless platform, the default.
std::vector<Candidate> candidates() {
    std::vector<Candidate> found;
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (has_extension(client, "EGL_EXT_platform_device") &&
        (has_extension(client, "EGL_EXT_device_base") ||
         (has_extension(client, "EGL_EXT_device_enumeration") &&
          has_extension(client, "EGL_EXT_device_query")))) {
        EGLDeviceEXT devices[16];
        EGLint count = 0;
        if (eglQueryDevicesEXT(16, devices, &count) == EGL_TRUE) {
            for (EGLint i = 0; i < count; ++i) {
                const char* extensions = eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS);
                if (!has_extension(extensions, "EGL_MESA_device_software")) {
                    found.push_back({fmt::format("device {}", i),
                                     eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr)});
                }
            }
        }
    }
    if (has_extension(client, "EGL_MESA_platform_surfaceless")) {
        found.push_back({"surfaceless platform", eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA,
                                                                          EGL_DEFAULT_DISPLAY, nullptr)});
    }
    found.push_back({"default display", eglGetDisplay(EGL_DEFAULT_DISPLAY)});
    return found;
}

/// Make an OpenGL 4.5 core context current; else the reason why not.
std::string try_candidate(EGLDisplay display, EGLContext& context) {
    EGLint major = 0;
    EGLint minor = 0;
    if (display == EGL_NO_DISPLAY || eglInitialize(display, &major, &minor) == EGL_FALSE) {
        return "no display";
    }
    const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
    if (!has_extension(extensions, "EGL_KHR_surfaceless_context") ||
        !has_extension(extensions, "EGL_KHR_no_config_context")) {
        return fmt::format("EGL {}.{} without surfaceless contexts", major, minor);
    }
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) {
        return fmt::format("EGL {}.{} without OpenGL", major, minor);
    }
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
    context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (context == EGL_NO_CONTEXT ||
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
        return fmt::format("EGL {}.{} without an OpenGL 4.5 core context (EGL error 0x{:x})", major, minor,
                           eglGetError());
    }
    return {};
}

} // namespace

Context::Context(std::unique_ptr<Egl> egl) : egl_(std::move(egl)) {}
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;
Context::~Context() = default;

Context Context::headless() {
    // epoxy ends the program where the library is missing, so ask for it first; it stays loaded.
    if (!dlopen("libEGL.so.1", RTLD_LAZY)) {
        throw support::failure("OpenGL 4.5 core through EGL is needed; found no EGL library: {}", dlerror());
    }
    std::string tried;
    for (const Candidate& candidate : candidates()) {
        auto egl = std::make_unique<Egl>();
        egl->display = candidate.display;
        const std::string reason = try_candidate(egl->display, egl->context);
        if (reason.empty()) {
            require_opengl_45();
            return Context(std::move(egl));
        }
        tried += fmt::format("{}{}: {}", tried.empty() ? "" : "; ", candidate.name, reason);
    }
    throw support::failure("OpenGL 4.5 core through EGL is needed; found {}", tried);
}

DriverInfo driver_info() {
    const auto text = [](GLenum name) {
        const auto* value = reinterpret_cast<const char*>(glGetString(name));
        return std::string(value ? value : "unknown");
    };
    return {text(GL_RENDERER), text(GL_VENDOR), text(GL_VERSION)};
}

bool runs_on_cpu() {
    const std::string renderer = driver_info().renderer;
    return renderer.find("llvmpipe") != std::string::npos || renderer.find("softpipe") != std::string::npos ||
           renderer.find("SwiftShader") != std::string::npos;
}

void require_opengl_45() {
    if (epoxy_gl_version() < 45 || !epoxy_is_desktop_gl()) {
        const DriverInfo info = driver_info();
        throw support::failure("OpenGL 4.5 core is needed; found {} on {}", info.version, info.renderer);
    }
}

void check_errors(const char* where) {
    const GLenum error = glGetError();
    if (error != GL_NO_ERROR) {
        throw support::failure("{}: OpenGL error 0x{:x}{}", where, error,
                               error == GL_OUT_OF_MEMORY ? " (out of memory)" : "");
    }
}

} // namespace renderer::gl
