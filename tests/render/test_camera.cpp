#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/random.hpp"
#include "render/camera.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::render;

namespace {

Camera someCamera(Random& random) {
    Camera camera;
    camera.target = {random.uniform(-3, 3), random.uniform(0, 2), random.uniform(-3, 3)};
    camera.distance = random.uniform(0.5F, 20.0F);
    camera.yaw = random.uniform(-kPi, kPi);
    camera.pitch = random.uniform(-1.4F, 1.4F);
    camera.fieldOfView = random.uniform(0.3F, 1.5F);
    return camera;
}

}  // namespace

TEST_CASE("the ray through a pixel meets every point that is projected onto it") {
    Random random(3);
    for (const bool orthographic : {false, true}) {
        for (const Extent size : {Extent{1280, 720}, Extent{333, 777}, Extent{1, 1}}) {
            for (int i = 0; i < 50; ++i) {
                Camera camera = someCamera(random);
                camera.orthographic = orthographic;
                const vec2 pixel(random.uniform(0, static_cast<float>(size.width)),
                                 random.uniform(0, static_cast<float>(size.height)));
                const Ray ray = worldRay(camera, pixel, size);
                CHECK(glm::length(ray.direction) == Approx(1.0F));
                const vec3 point = ray.origin + ray.direction * (camera.distance * random.uniform(0.5F, 2.0F));
                const auto seen = project(camera, point, size);
                REQUIRE(seen.has_value());
                CHECK(seen->x == Approx(pixel.x).margin(2e-3 * size.width));
                CHECK(seen->y == Approx(pixel.y).margin(2e-3 * size.height));
            }
        }
    }
}

TEST_CASE("the middle of the picture looks at the target from the eye") {
    Random random(4);
    for (int i = 0; i < 20; ++i) {
        const Camera camera = someCamera(random);
        const Ray ray = worldRay(camera, {320, 180}, {640, 360});
        CHECK(glm::length(ray.origin - eyeOf(camera)) < 1e-5F);
        CHECK(glm::length(ray.origin + ray.direction * camera.distance - camera.target) < 1e-4F * camera.distance);
        CHECK(glm::length(eyeOf(camera) - camera.target) == Approx(camera.distance));
    }
}

TEST_CASE("at yaw and pitch zero the eye stands on +Z with +X to the right, and both angles turn as told") {
    Camera camera;
    camera.target = vec3(0);
    camera.distance = 2.0F;
    camera.yaw = 0.0F;
    camera.pitch = 0.0F;
    CHECK(glm::length(eyeOf(camera) - vec3(0, 0, 2)) < 1e-6F);
    CHECK(glm::length(rightOf(camera) - vec3(1, 0, 0)) < 1e-6F);
    CHECK(glm::length(upOf(camera) - vec3(0, 1, 0)) < 1e-6F);
    camera.yaw = 0.5F * kPi;
    CHECK(glm::length(eyeOf(camera) - vec3(2, 0, 0)) < 1e-5F);
    camera.pitch = 0.3F;
    CHECK(eyeOf(camera).y == Approx(2.0F * std::sin(0.3F)));
}

TEST_CASE("orbiting stops short of the poles and keeps the target in the middle") {
    Camera camera;
    orbit(camera, 0.4F, 10.0F);
    CHECK(camera.pitch < 0.5F * kPi);
    CHECK(camera.pitch > 1.5F);
    orbit(camera, 20.0F, -20.0F);
    CHECK(camera.pitch > -0.5F * kPi);
    CHECK(std::abs(camera.yaw) <= kPi + 1e-5F);
    const auto seen = project(camera, camera.target, {200, 100});
    REQUIRE(seen.has_value());
    CHECK(seen->x == Approx(100.0F).margin(1e-3));
    CHECK(seen->y == Approx(50.0F).margin(1e-3));
}

TEST_CASE("panning moves what lies in the target's plane with the mouse") {
    Camera camera;
    const Extent size{800, 600};
    const vec3 point = camera.target + 0.3F * rightOf(camera) - 0.2F * upOf(camera);
    const vec3 before = project(camera, point, size).value();
    pan(camera, {37, -21}, size);
    const vec3 after = project(camera, point, size).value();
    CHECK(after.x - before.x == Approx(37.0F).margin(0.01));
    CHECK(after.y - before.y == Approx(-21.0F).margin(0.01));
}

TEST_CASE("dollying scales the distance within its bounds") {
    Camera camera;
    camera.distance = 4.0F;
    dolly(camera, 0.5F);
    CHECK(camera.distance == Approx(2.0F));
    dolly(camera, 1e-9F);
    CHECK(camera.distance == Approx(0.01F));
    dolly(camera, 1e9F);
    CHECK(camera.distance == Approx(1000.0F));
}

TEST_CASE("a framed sphere touches the edge of the picture and does not cross it") {
    for (const bool orthographic : {false, true}) {
        for (const Extent size : {Extent{1600, 900}, Extent{500, 900}}) {
            Camera camera;
            camera.orthographic = orthographic;
            const vec3 center(0.3F, 1.1F, -0.4F);
            const float radius = 0.8F;
            frameSphere(camera, center, radius, size.aspect(), 1.0F);
            float nearest = 1e9F;  // pixels from the outline to the nearest edge
            for (int i = 0; i < 3000; ++i) {
                // Points all over the sphere (a spiral), so that the outline is among them.
                const float y = 1.0F - 2.0F * (static_cast<float>(i) + 0.5F) / 3000.0F;
                const float around = static_cast<float>(i) * 2.3999632F;
                const float flat = std::sqrt(1.0F - y * y);
                const vec3 point = center + radius * vec3(flat * std::cos(around), y, flat * std::sin(around));
                const vec3 seen = project(camera, point, size).value();
                nearest = std::min({nearest, seen.x, seen.y, static_cast<float>(size.width) - seen.x,
                                    static_cast<float>(size.height) - seen.y});
            }
            CHECK(nearest > -0.01F * static_cast<float>(size.height));
            CHECK(nearest < 0.02F * static_cast<float>(size.height));
        }
    }
}

TEST_CASE("points behind the eye are not projected") {
    Camera camera;
    const vec3 behind = eyeOf(camera) - forwardOf(camera);
    CHECK_FALSE(project(camera, behind, {100, 100}).has_value());
}

TEST_CASE("points are framed by the free part of the picture, whatever lies over its edges") {
    const std::vector<vec3> points{{-1, 0, 0}, {2, 0.5F, 1}, {0, 3, -1}, {0.5F, 1, 4}};
    const Extent size{1280, 720};
    for (const PictureInsets& insets :
         {PictureInsets{}, PictureInsets{0.24F, 0.27F, 0.12F, 0.04F}, PictureInsets{0.6F, 0.0F, 0.0F, 0.3F}}) {
        for (const bool flat : {false, true}) {
            Camera camera;
            camera.orthographic = flat;
            camera.yaw = 0.7F;
            camera.pitch = 0.3F;
            framePoints(camera, points, size.aspect(), insets);
            vec2 low(1e9F);
            vec2 high(-1e9F);
            for (const vec3& point : points) {
                const auto seen = project(camera, point, size);
                REQUIRE(seen.has_value());
                low = glm::min(low, vec2(*seen));
                high = glm::max(high, vec2(*seen));
            }
            const float left = insets.left * 1280.0F;
            const float right = (1.0F - insets.right) * 1280.0F;
            const float top = insets.top * 720.0F;
            const float bottom = (1.0F - insets.bottom) * 720.0F;
            CHECK(low.x > left - 0.1F);
            CHECK(high.x < right + 0.1F);
            CHECK(low.y > top - 0.1F);
            CHECK(high.y < bottom + 0.1F);
            // As near as can be: one way across it reaches both edges.
            const bool across = low.x < left + 0.5F && high.x > right - 0.5F;
            const bool upright = low.y < top + 0.5F && high.y > bottom - 0.5F;
            CHECK((across || upright));
            // In the middle of what is free, the other way, too.
            CHECK(low.x - left == Approx(right - high.x).margin(1.0F));
            CHECK(low.y - top == Approx(bottom - high.y).margin(1.0F));
        }
    }
}
