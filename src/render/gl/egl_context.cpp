#include "render/gl/egl_context.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace lutka::render {
namespace {

// A way to a display, with its name for the error text.
struct Platform {
    const char* name;
    EGLDisplay display;
};

bool offers(const char* extensions, std::string_view wanted) {
    return extensions != nullptr && std::string_view(extensions).find(wanted) != std::string_view::npos;
}

// In order of trust: no device or window system involved, the GPUs by name, whatever the environment offers.
std::vector<Platform> platforms() {
    std::vector<Platform> found;
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto getDisplay =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (getDisplay != nullptr && offers(extensions, "EGL_MESA_platform_surfaceless")) {
        found.push_back({"surfaceless",
                         getDisplay(EGL_PLATFORM_SURFACELESS_MESA, static_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr)});
    }
    const auto queryDevices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    if (getDisplay != nullptr && queryDevices != nullptr && offers(extensions, "EGL_EXT_platform_device")) {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        if (queryDevices(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_TRUE) {
            for (EGLint i = 0; i < count; ++i)
                found.push_back({"device", getDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr)});
        }
    }
    found.push_back({"default", eglGetDisplay(EGL_DEFAULT_DISPLAY)});
    return found;
}

constexpr EGLint kConfigAttributes[] = {EGL_SURFACE_TYPE,
                                        EGL_PBUFFER_BIT,
                                        EGL_RENDERABLE_TYPE,
                                        EGL_OPENGL_BIT,
                                        EGL_RED_SIZE,
                                        8,
                                        EGL_GREEN_SIZE,
                                        8,
                                        EGL_BLUE_SIZE,
                                        8,
                                        EGL_ALPHA_SIZE,
                                        8,
                                        EGL_NONE};
constexpr EGLint kContextAttributes[] = {
    EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
// The same, and it says so when the GPU was reset: not every driver has such contexts.
constexpr EGLint kTellingAttributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                         3,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         3,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                         EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                                         EGL_LOSE_CONTEXT_ON_RESET,
                                         EGL_NONE};
// Nothing is drawn into it; some drivers only refuse to be current without one.
constexpr EGLint kSurfaceAttributes[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};

std::string eglWords(const char* call) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%s failed with 0x%04x", call, static_cast<unsigned>(eglGetError()));
    return text.data();
}

}  // namespace

std::unique_ptr<EglContext> EglContext::open(void* display, std::string& why) {
    const auto fail = [&](const char* call) {
        why = eglWords(call);
        return nullptr;
    };
    if (display == EGL_NO_DISPLAY) return fail("eglGetPlatformDisplay");
    if (eglInitialize(display, nullptr, nullptr) != EGL_TRUE) return fail("eglInitialize");
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return fail("eglBindAPI");
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglChooseConfig(display, kConfigAttributes, &config, 1, &count) != EGL_TRUE || count == 0) {
        return fail("eglChooseConfig");
    }
    std::unique_ptr<EglContext> egl(new EglContext());
    egl->display_ = display;
    egl->context_ = eglCreateContext(display, config, EGL_NO_CONTEXT, kTellingAttributes);
    if (egl->context_ == EGL_NO_CONTEXT)
        egl->context_ = eglCreateContext(display, config, EGL_NO_CONTEXT, kContextAttributes);
    if (egl->context_ == EGL_NO_CONTEXT) return fail("eglCreateContext");
    egl->surface_ = eglCreatePbufferSurface(display, config, kSurfaceAttributes);
    if (eglMakeCurrent(display, egl->surface_, egl->surface_, egl->context_) != EGL_TRUE) return fail("eglMakeCurrent");
    return egl;
}

// The display stays initialised: it is one for the whole process, and other contexts may live on it.
EglContext::~EglContext() {
    if (eglGetCurrentContext() == context_) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
}

void EglContext::makeCurrent() {
    eglMakeCurrent(display_, surface_, surface_, context_);
}

void EglContext::releaseCurrent() {
    const EGLDisplay display = eglGetCurrentDisplay();
    if (display != EGL_NO_DISPLAY) eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

EglContext::Loader EglContext::loader() const {
    return eglGetProcAddress;
}

Result<std::unique_ptr<EglContext>> EglContext::create() {
    std::string tried;
    for (const Platform& platform : platforms()) {
        std::string why;
        if (auto context = open(platform.display, why)) return context;
        tried += (tried.empty() ? "" : "; ") + std::string(platform.name) + ": " + why;
    }
    return Error{ErrorCode::noDisplay, "no OpenGL 3.3 context without a display (EGL: " + tried + ")", "", ""};
}

}  // namespace lutka::render
