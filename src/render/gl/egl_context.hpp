#pragma once

#include <memory>
#include <string>

#include "core/result.hpp"

namespace lutka::render {

/// An OpenGL 3.3 core context without a window, by EGL.
class EglContext {
  public:
    using Function = void (*)();
    using Loader = Function (*)(const char* name);

    /// Makes one and makes it current. Fails with ErrorCode::noDisplay, telling what each platform answered.
    [[nodiscard]] static Result<std::unique_ptr<EglContext>> create();

    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;
    ~EglContext();

    void makeCurrent();
    /// Lets go of whichever EGL context is current on this thread: EGL and a window system's own GL do not mix.
    static void releaseCurrent();
    [[nodiscard]] Loader loader() const;

  private:
    EglContext() = default;
    static std::unique_ptr<EglContext> open(void* display, std::string& why);

    // EGL's handles are opaque pointers; kept so, no EGL header is needed here.
    void* display_ = nullptr;
    void* surface_ = nullptr;
    void* context_ = nullptr;
};

}  // namespace lutka::render
