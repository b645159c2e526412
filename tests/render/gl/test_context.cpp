// glad first: GLFW must not bring in the system's GL header.
#include <glad/gl.h>

#include <GLFW/glfw3.h>

#include <cstdlib>

#include "gl_fixture.hpp"

using namespace lutka;
using namespace lutka::test;
using namespace lutka::render;

TEST_CASE("without a display a window is refused with the reason and what would mend it") {
    ::unsetenv("DISPLAY");
    ::unsetenv("WAYLAND_DISPLAY");
    const Result<GlContext> window = GlContext::createWindow({});
    REQUIRE_FALSE(window.ok());
    CHECK(window.error().code == ErrorCode::noDisplay);
    CHECK_FALSE(window.error().message.empty());
    CHECK_FALSE(window.error().mend.empty());
}

TEST_CASE("a headless context has no window, no size, and tells its driver") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    CHECK(gl->context.window() == nullptr);
    CHECK(gl->context.framebufferSize() == Extent{0, 0});
    CHECK(gl->context.description().find(", ") != std::string::npos);
    gl->context.swapBuffers();
}

TEST_CASE("two headless contexts live side by side, and either can go first") {
    auto first = GlFixture::create();
    NEEDS_GL(first);
    auto second = GlFixture::create();
    REQUIRE(second);
    FrameDescription frame;
    const Image fromSecond = second->picture(frame, {64, 48});
    first->context.makeCurrent();
    CHECK(first->picture(frame, {64, 48}).rgba == fromSecond.rgba);
    first.reset();
    second->context.makeCurrent();
    CHECK(second->picture(frame, {64, 48}).rgba == fromSecond.rgba);
}

TEST_CASE("a window shows the same picture as the headless context") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    FrameDescription frame;
    const Extent size{160, 120};
    const Image expected = gl->picture(frame, size);
    Result<GlContext> window =
        GlContext::createWindow({.title = "test", .size = size, .visible = false, .vsync = false});
    if (!window) SKIP_TEST("%s", window.error().text().c_str());
    Result<Renderer> renderer = Renderer::create(window.value());
    REQUIRE(renderer.ok());
    renderer.value().draw(frame, size);
    renderer.value().present(window.value().framebufferSize());
    window.value().swapBuffers();
    const ImageDifference difference = compareImages(renderer.value().readPixels(), expected, 4);
    CHECK(difference.differingShare < 0.01);
    CHECK(glfwGetWindowAttrib(window.value().window(), GLFW_VISIBLE) == GLFW_FALSE);
    // And back: the two kinds of context take turns.
    gl->context.makeCurrent();
    CHECK(gl->picture(frame, size).rgba == expected.rgba);
    window.value().makeCurrent();
}

TEST_CASE("a wrong call is told by the driver, where it can") {
    ::unsetenv("LUTKA_GL_DEBUG");  // it would end here
    auto context = GlContext::createHeadless();
    if (!context) SKIP_TEST("no headless OpenGL context");
    CHECK(context.value().messages().empty());
    if (!context.value().keepMessages()) return;  // a driver without KHR_debug
    glEnable(GL_RGBA8);                           // nothing that can be enabled
    CHECK(context.value().messages().size() == 1);
    CHECK(glGetError() == GL_INVALID_ENUM);
}

TEST_CASE("a context is not lost until its driver says so") {
    auto sound = GlContext::createHeadless();
    if (!sound) SKIP_TEST("no headless OpenGL context");
    for (int i = 0; i < 3; ++i)
        CHECK_FALSE(sound.value().lost());
    ::setenv("LUTKA_GL_LOSE", "2", 1);
    auto context = GlContext::createHeadless();
    ::unsetenv("LUTKA_GL_LOSE");
    REQUIRE(context.ok());
    CHECK_FALSE(context.value().lost());
    CHECK(context.value().lost());
    CHECK(context.value().lost());
    CHECK(GlContext::lostError().code == ErrorCode::noDisplay);
}
