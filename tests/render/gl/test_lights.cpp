// Each kind of light alone, as pictures and as numbers, and a shadow that stays where it is while the camera moves.

#include <cmath>

#include "lone_figure.hpp"
#include "render/gl/golden.hpp"
#include "render/gl/pixels.hpp"
#include "render/shadow_fit.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::test;
using namespace lutka::render;

namespace {

constexpr Extent kLightsSize{320, 240};

/// A figure between a box and a ball, in the dark.
struct DarkRoom : LoneFigure {
    explicit DarkRoom(GlFixture& gl) : LoneFigure(gl) {
        PropItem box;
        box.worldFromShape.translation = {-0.8F, 0.25F, -0.3F};
        box.halfExtents = vec3(0.25F);
        PropItem ball;
        ball.kind = ShapeKind::sphere;
        ball.radius = 0.22F;
        ball.roughness = 0.25F;
        ball.worldFromShape.translation = {0.75F, 0.22F, 0.3F};
        frame.props = {box, ball};
        frame.sun.intensity = 0.0F;
        frame.sky.intensity = 0.0F;
        frame.ambientOcclusion = false;
        frameSphere(frame.camera, {0, 0.8F, 0}, 1.15F, kLightsSize.aspect());
    }
};

LocalLight lamp(const vec3& position) {
    LocalLight light;
    light.position = position;
    light.intensity = 1.5F;
    light.range = 4.0F;
    return light;
}

}  // namespace

TEST_CASE("picture: the sun alone with its shadow") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    DarkRoom room(*gl);
    room.frame.sun.intensity = 2.2F;
    checkGolden(gl->picture(room.frame, kLightsSize), "light_sun");
}

TEST_CASE("picture: the sky alone, then with ambient occlusion") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    DarkRoom room(*gl);
    room.frame.sky.intensity = 0.9F;
    checkGolden(gl->picture(room.frame, kLightsSize), "light_sky");
    room.frame.ambientOcclusion = true;
    checkGolden(gl->picture(room.frame, kLightsSize), "light_occlusion");
}

TEST_CASE("picture: two point lights of different colours") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    DarkRoom room(*gl);
    room.frame.localLights = {lamp({-1.2F, 1.2F, 0.9F}), lamp({1.3F, 1.5F, 0.7F})};
    room.frame.localLights[0].color = {1.0F, 0.45F, 0.2F};
    room.frame.localLights[1].color = {0.25F, 0.5F, 1.0F};
    checkGolden(gl->picture(room.frame, kLightsSize), "light_points");
}

TEST_CASE("picture: a spot light from above with a soft rim") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    DarkRoom room(*gl);
    LocalLight spot = lamp({0.4F, 2.6F, 1.2F});
    spot.intensity = 9.0F;
    spot.range = 6.0F;
    spot.direction = glm::normalize(vec3(0, 0.4F, 0) - spot.position);
    spot.outerAngle = radians(24);
    spot.innerAngle = radians(14);
    room.frame.localLights = {spot};
    checkGolden(gl->picture(room.frame, kLightsSize), "light_spot");
}

TEST_CASE("eight local lights add up and a ninth is left out") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    DarkRoom room(*gl);
    room.frame.characters.clear();
    room.frame.props.clear();
    room.frame.floor.gridSpacing = 0.0F;
    const vec3 below(0.3F, 0, 0.2F);
    const auto shown = [&](int count) {
        room.frame.localLights.assign(static_cast<std::size_t>(count), lamp({0.3F, 1.0F, 0.2F}));
        for (LocalLight& light : room.frame.localLights)
            light.intensity = 0.08F;
        return brightness(pixelAt(gl->picture(room.frame, kLightsSize), room.frame.camera, below));
    };
    int last = shown(0);
    for (int count = 1; count <= 8; ++count) {
        const int now = shown(count);
        CHECK(now > last);
        last = now;
    }
    CHECK(shown(9) == last);
    CHECK(shown(40) == last);
}

TEST_CASE("the shadow map's texels stay where they are in the world while the camera moves") {
    // Casters all over: the fit follows what the camera looks at.
    const BoundingSphere casters{{0, 1, 0}, 80.0F};
    const vec3 sun(-0.5F, 0.9F, 0.55F);
    constexpr int kMap = 1024;
    Camera camera;
    const ShadowFit start = fitShadow(casters, sun, camera, kMap);
    const auto texelOf = [](const ShadowFit& fit, const vec3& world) {
        const vec4 clip = fit.lightFromWorld * vec4(world, 1.0F);
        return vec2(clip) * (0.5F * kMap);
    };
    const vec3 landmark(0.2F, 0.3F, -0.1F);
    const vec2 phase = texelOf(start, landmark);
    bool moved = false;
    for (int i = 1; i <= 60; ++i) {
        camera.target += vec3(0.31F, 0.05F, 0.17F) * start.metresPerTexel;
        const ShadowFit now = fitShadow(casters, sun, camera, kMap);
        CHECK(now.metresPerTexel == start.metresPerTexel);
        const vec2 shift = texelOf(now, landmark) - phase;
        CHECK(std::abs(shift.x - std::round(shift.x)) < 0.02F);
        CHECK(std::abs(shift.y - std::round(shift.y)) < 0.02F);
        moved = moved || std::abs(shift.x) > 0.5F || std::abs(shift.y) > 0.5F;
    }
    CHECK(moved);  // it did follow
}

TEST_CASE("a shadow's edge does not swim: moved by a few pixels the picture is the same, moved") {
    // Without the noise of the soft filter, which is fixed to the pixels.
    const auto gl =
        GlFixture::create({.samples = 1, .shadowMapSize = 512, .ambientOcclusion = false, .fastShading = true});
    NEEDS_GL(gl);
    FrameDescription frame;
    frame.floor.gridSpacing = 0.0F;
    frame.floor.fadeDistance = 500.0F;
    PropItem post;
    post.halfExtents = {0.15F, 0.4F, 0.15F};
    post.worldFromShape.translation = {0, 0.4F, 0};
    PropItem far = post;
    far.worldFromShape.translation = {40, 0.4F, 40};  // so that the fit follows the camera
    frame.props = {post, far};
    frame.camera.orthographic = true;
    frame.camera.pitch = radians(89);
    frame.camera.yaw = 0.0F;
    frame.camera.target = vec3(0);
    frame.camera.distance = 3.0F;
    const Image first = gl->picture(frame, kLightsSize);
    const float metresPerPixel = 2.0F * frame.camera.distance * std::tan(0.5F * frame.camera.fieldOfView) /
                                 static_cast<float>(kLightsSize.height);
    for (const int pixels : {1, 2, 3, 5, 9}) {
        frame.camera.target = rightOf(frame.camera) * (metresPerPixel * static_cast<float>(pixels));
        const Image now = gl->picture(frame, kLightsSize);
        int worst = 0;
        int dark = 0;
        // The pixel's place in the gradient of the backdrop changes a little; the shadow's edge would by far more.
        for (int y = 60; y < 180; ++y) {
            for (int x = 80; x < 240; ++x) {
                worst = std::max(worst, std::abs(now.at(x - pixels, y).g - first.at(x, y).g));
                dark += first.at(x, y).g < 130 ? 1 : 0;
            }
        }
        INFO(pixels << " pixels");
        CHECK(dark > 200);  // the shadow is there
        CHECK(worst <= 12);
    }
}
