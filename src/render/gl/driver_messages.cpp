#include "render/gl/driver_messages.hpp"

#include <glad/gl.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace lutka::render {
namespace {

// Of GL 4.3 and KHR_debug, which a context of 3.3 may have beside its own functions.
constexpr GLenum kDebugOutput = 0x92E0;
constexpr GLenum kDebugOutputSynchronous = 0x8242;
constexpr GLenum kSourceShaderCompiler = 0x8248;
constexpr GLenum kSeverityHigh = 0x9146;
constexpr GLenum kSeverityMedium = 0x9147;
constexpr std::size_t kMostMessages = 100;
using DebugCallback = void(GLAD_API_PTR*)(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                          const GLchar* message, const void* user);
using SetDebugCallback = void(GLAD_API_PTR*)(DebugCallback callback, const void* user);

void GLAD_API_PTR keepMessage(GLenum source, GLenum /*type*/, GLuint /*id*/, GLenum severity, GLsizei /*length*/,
                              const GLchar* message, const void* user) {
    if (source == kSourceShaderCompiler || (severity != kSeverityHigh && severity != kSeverityMedium)) return;
    static_cast<DriverMessages*>(const_cast<void*>(user))->add(message);
}

}  // namespace

bool hasGlExtension(const char* name) {
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i) {
        const GLubyte* extension = glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(i));
        if (extension != nullptr && std::string_view(name) == reinterpret_cast<const char*>(extension)) return true;
    }
    return false;
}

std::unique_ptr<DriverMessages> DriverMessages::listen(Loader loader, bool fatal) {
    if (!hasGlExtension("GL_KHR_debug")) return nullptr;
    const auto set = reinterpret_cast<SetDebugCallback>(loader("glDebugMessageCallback"));
    if (set == nullptr) return nullptr;
    std::unique_ptr<DriverMessages> messages(new DriverMessages(fatal));
    glEnable(kDebugOutput);
    glEnable(kDebugOutputSynchronous);
    set(keepMessage, messages.get());
    return messages;
}

void DriverMessages::add(std::string message) {
    if (fatal_) {
        std::fprintf(stderr, "OpenGL: %s\n", message.c_str());
        std::abort();
    }
    if (messages_.size() < kMostMessages) messages_.push_back(std::move(message));
}

}  // namespace lutka::render
