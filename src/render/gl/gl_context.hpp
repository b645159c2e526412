#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "render/extent.hpp"

struct GLFWwindow;

namespace lutka::render {

/// How to open a window.
struct WindowOptions {
    std::string title = "Lutka";
    Extent size{1280, 720};  ///< Screen coordinates.
    bool visible = true;
    bool vsync = true;
};

/// An OpenGL 3.3 core context with its functions loaded, current on the thread that made it. It owns its display
/// connection or window; Renderer and every other GL object must die before it.
///
/// Environment variables for tests and debugging: LUTKA_GL_DEBUG=1 ends the program at the first error that the driver
/// reports. LUTKA_GL_LOSE=N makes lost() return true from its Nth call on.
class GlContext {
  public:
    /// Without a display or window, by EGL: Mesa's surfaceless platform first, then the GPUs that EGL enumerates, then
    /// the default display. Works on Mesa's software rasteriser. Fails with ErrorCode::noDisplay.
    [[nodiscard]] static Result<GlContext> createHeadless();

    /// A GLFW window (GLFW is initialised for it). Fails with ErrorCode::noDisplay.
    [[nodiscard]] static Result<GlContext> createWindow(const WindowOptions& options);

    GlContext(GlContext&&) noexcept;
    GlContext& operator=(GlContext&&) noexcept;
    ~GlContext();

    void makeCurrent();

    /// The window; null when headless. For callbacks and the UI's back end: GLFW's user pointer is the caller's.
    [[nodiscard]] GLFWwindow* window() const;

    /// The window's framebuffer in pixels; {0, 0} while it is minimised and when headless.
    [[nodiscard]] Extent framebufferSize() const;

    /// Shows what was drawn; nothing when headless.
    void swapBuffers();
    void setVsync(bool on);

    /// Whether the driver gave the context up (a reset of the GPU, its removal): nothing is drawn from then on, and
    /// what was uploaded is gone. Never where the driver can't tell. Cheap; ask once a frame.
    [[nodiscard]] bool lost();
    /// What to say then.
    [[nodiscard]] static Error lostError();

    /// From now on the driver's complaints (see DriverMessages) are kept. False where it can't.
    bool keepMessages();
    /// Those so far.
    [[nodiscard]] std::vector<std::string> messages() const;

    /// The driver's own words, for reports: "vendor, renderer, version".
    [[nodiscard]] const std::string& description() const;
    /// Whether the processor draws (Mesa's llvmpipe and softpipe, SwiftShader), by the driver's name.
    [[nodiscard]] bool isSoftware() const;

  private:
    struct State;
    explicit GlContext(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace lutka::render
