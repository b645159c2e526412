#include "render/gl/gl_context.hpp"

// glad first: GLFW must not bring in the system's GL header.
#include <glad/gl.h>

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "render/gl/driver_messages.hpp"
#include "render/gl/egl_context.hpp"

namespace lutka::render {
namespace {

constexpr const char* kMend = "install a driver for OpenGL 3.3 (package libgl1-mesa-dri for software rendering)";

struct DestroyWindow {
    void operator()(GLFWwindow* window) const {
        glfwDestroyWindow(window);
        glfwTerminate();
    }
};

std::string textOf(GLenum what) {
    const GLubyte* text = glGetString(what);
    return text != nullptr ? reinterpret_cast<const char*>(text) : "unknown";
}

// Of GL 4.5, KHR_robustness and ARB_robustness.
using ResetStatus = GLenum(GLAD_API_PTR*)();

ResetStatus resetStatusOf(GLADloadfunc loader) {
    const bool khr = hasGlExtension("GL_KHR_robustness");
    if (!khr && !hasGlExtension("GL_ARB_robustness")) return nullptr;
    return reinterpret_cast<ResetStatus>(loader(khr ? "glGetGraphicsResetStatus" : "glGetGraphicsResetStatusARB"));
}

// A whole number of the environment; 0 where there is none.
int numberOfEnvironment(const char* name) {
    const char* text = std::getenv(name);
    return text != nullptr ? std::atoi(text) : 0;
}

Error noDisplay(const std::string& message) {
    return {ErrorCode::noDisplay, message, "", kMend};
}

// GLFW's last words, read right after a call that failed.
std::string glfwWords() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "no reason given";
}

}  // namespace

struct GlContext::State {
    std::unique_ptr<EglContext> egl;
    std::unique_ptr<GLFWwindow, DestroyWindow> window;
    std::string description;
    GLADloadfunc loader = nullptr;
    ResetStatus resetStatus = nullptr;
    int asksUntilLost = numberOfEnvironment("LUTKA_GL_LOSE");  // 0: never
    bool lost = false;
    std::unique_ptr<DriverMessages> messages;

    // Loads GL's functions for the current context.
    Result<void> load(GLADloadfunc from) {
        loader = from;
        if (gladLoadGL(from) == 0) return noDisplay("the functions of OpenGL 3.3 can't be loaded");
        resetStatus = resetStatusOf(from);
        if (numberOfEnvironment("LUTKA_GL_DEBUG") != 0) messages = DriverMessages::listen(from, true);
        description = textOf(GL_VENDOR) + ", " + textOf(GL_RENDERER) + ", " + textOf(GL_VERSION);
        return {};
    }
};

GlContext::GlContext(std::unique_ptr<State> state) : state_(std::move(state)) {}
GlContext::GlContext(GlContext&&) noexcept = default;
GlContext& GlContext::operator=(GlContext&&) noexcept = default;
GlContext::~GlContext() = default;

Result<GlContext> GlContext::createHeadless() {
    auto state = std::make_unique<State>();
    Result<std::unique_ptr<EglContext>> egl = EglContext::create();
    if (!egl) return noDisplay(egl.error().message);
    state->egl = std::move(egl).value();
    const Result<void> loaded = state->load(state->egl->loader());
    if (!loaded) return loaded.error();
    return GlContext(std::move(state));
}

Result<GlContext> GlContext::createWindow(const WindowOptions& options) {
    if (glfwInit() != GLFW_TRUE) {
        Error none = noDisplay("no window system: " + glfwWords());
        none.mend = "set DISPLAY to a running X server; pictures, and the editor with --headless, need none";
        return none;
    }
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_VISIBLE, options.visible ? GLFW_TRUE : GLFW_FALSE);
    // The renderer multisamples in its own framebuffer; the window needs no depth.
    glfwWindowHint(GLFW_SAMPLES, 0);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    EglContext::releaseCurrent();  // GLFW makes the window's context current to look at it
    const auto create = [&] {
        return glfwCreateWindow(options.size.width, options.size.height, options.title.c_str(), nullptr, nullptr);
    };
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
    GLFWwindow* window = create();
    if (window == nullptr) {  // a driver that knows no such contexts
        glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_NO_ROBUSTNESS);
        window = create();
    }
    if (window == nullptr) {
        const Error error = noDisplay("no window with OpenGL 3.3: " + glfwWords());
        glfwTerminate();
        return error;
    }
    auto state = std::make_unique<State>();
    state->window.reset(window);
    glfwMakeContextCurrent(window);
    const Result<void> loaded = state->load(glfwGetProcAddress);
    if (!loaded) return loaded.error();
    glfwSwapInterval(options.vsync ? 1 : 0);
    return GlContext(std::move(state));
}

bool GlContext::lost() {
    if (state_->asksUntilLost > 0 && --state_->asksUntilLost == 0) state_->lost = true;
    if (state_->resetStatus != nullptr && state_->resetStatus() != GL_NO_ERROR) state_->lost = true;
    return state_->lost;
}

Error GlContext::lostError() {
    return {ErrorCode::noDisplay, "the graphics driver gave up: its context is lost", "",
            "start again; if it happens again, update the driver or take another GPU"};
}

bool GlContext::keepMessages() {
    if (state_->messages == nullptr) state_->messages = DriverMessages::listen(state_->loader, false);
    return state_->messages != nullptr;
}

std::vector<std::string> GlContext::messages() const {
    return state_->messages != nullptr ? state_->messages->all() : std::vector<std::string>{};
}

void GlContext::makeCurrent() {
    if (state_->window) {
        EglContext::releaseCurrent();
        glfwMakeContextCurrent(state_->window.get());
    } else {
        glfwMakeContextCurrent(nullptr);  // does nothing as long as there never was a window
        state_->egl->makeCurrent();
    }
}

GLFWwindow* GlContext::window() const {
    return state_->window.get();
}

Extent GlContext::framebufferSize() const {
    Extent size{0, 0};
    if (state_->window) glfwGetFramebufferSize(state_->window.get(), &size.width, &size.height);
    return size;
}

void GlContext::swapBuffers() {
    if (state_->window) glfwSwapBuffers(state_->window.get());
}

void GlContext::setVsync(bool on) {
    if (state_->window) glfwSwapInterval(on ? 1 : 0);
}

const std::string& GlContext::description() const {
    return state_->description;
}

bool GlContext::isSoftware() const {
    constexpr std::array<std::string_view, 4> kNames = {"llvmpipe", "softpipe", "SwiftShader", "Software Rasterizer"};
    return std::any_of(kNames.begin(), kNames.end(),
                       [&](std::string_view name) { return state_->description.find(name) != std::string::npos; });
}

}  // namespace lutka::render
