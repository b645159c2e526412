#pragma once

#include <glad/gl.h>

#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "animation/pose.hpp"
#include "core/random.hpp"
#include "render/gl/renderer.hpp"
#include "support/catch.hpp"
#include "support/skip.hpp"

namespace lutka::test {

/// A headless context with a renderer; null where none can be had (NEEDS_GL). Whatever a test does with it, the driver
/// must have nothing to say against it in the end.
struct GlFixture {
    render::GlContext context;
    render::Renderer renderer;

    static std::unique_ptr<GlFixture> create(const render::RendererOptions& options = {}) {
        Result<render::GlContext> context = render::GlContext::createHeadless();
        if (!context) {
            std::fprintf(stderr, "%s\n", context.error().text().c_str());
            return nullptr;
        }
        static_cast<void>(context.value().keepMessages());
        Result<render::Renderer> renderer = render::Renderer::create(context.value(), options);
        if (!renderer) FAIL(renderer.error().text());
        return std::unique_ptr<GlFixture>(new GlFixture(std::move(context).value(), std::move(renderer).value()));
    }

    GlFixture(render::GlContext own, render::Renderer made) : context(std::move(own)), renderer(std::move(made)) {}
    GlFixture(const GlFixture&) = delete;
    GlFixture& operator=(const GlFixture&) = delete;
    ~GlFixture() {
        context.makeCurrent();
        CHECK(glGetError() == GL_NO_ERROR);
        for (const std::string& message : context.messages())
            FAIL_CHECK(message);
    }

    [[nodiscard]] render::CharacterHandle upload(const animation::Character& character) {
        const Result<render::CharacterHandle> handle = renderer.uploadCharacter(character);
        if (!handle) FAIL(handle.error().text());
        return handle.value();
    }

    [[nodiscard]] render::Image picture(const render::FrameDescription& frame, render::Extent size) {
        renderer.draw(frame, size);
        return renderer.readPixels();
    }
};

/// The palette of a pose.
[[nodiscard]] inline std::vector<animation::SkinMatrix> paletteOf(const animation::Skeleton& skeleton,
                                                                  const std::vector<RigidTransform>& modelFromJoint) {
    std::vector<animation::SkinMatrix> palette(modelFromJoint.size());
    animation::skinMatrices(skeleton.bindModelFromJoint, modelFromJoint, palette);
    return palette;
}

[[nodiscard]] inline std::vector<animation::SkinMatrix> bindPalette(const animation::Skeleton& skeleton) {
    return paletteOf(skeleton, skeleton.bindModelFromJoint);
}

/// Every joint of the node pose turned about a random axis by up to `angle` radians.
[[nodiscard]] inline std::vector<animation::SkinMatrix> randomPalette(const animation::Skeleton& skeleton,
                                                                      Random& random, float angle) {
    std::vector<RigidTransform> pose = skeleton.nodeParentFromJoint;
    for (RigidTransform& joint : pose) {
        const vec3 axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1F, 1));
        joint.rotation = joint.rotation * glm::angleAxis(random.uniform(-angle, angle), glm::normalize(axis));
    }
    animation::localToModel(skeleton, pose, pose);
    return paletteOf(skeleton, pose);
}

}  // namespace lutka::test

/// Skips the test case where no headless context can be had; `fixture` is what GlFixture::create() gave.
#define NEEDS_GL(fixture) \
    if ((fixture) == nullptr) SKIP_TEST("no headless OpenGL context")
