#include <algorithm>
#include <glm/geometric.hpp>

#include "animation/pose.hpp"
#include "core/random.hpp"
#include "render/bounds.hpp"
#include "render/shadow_fit.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::render;

namespace {

std::vector<animation::SkinMatrix> randomPalette(const animation::Skeleton& skeleton, Random& random) {
    std::vector<RigidTransform> pose = skeleton.nodeParentFromJoint;
    for (RigidTransform& joint : pose) {
        const vec3 axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1F, 1));
        joint.rotation = joint.rotation * glm::angleAxis(random.uniform(-1.5F, 1.5F), glm::normalize(axis));
    }
    animation::localToModel(skeleton, pose, pose);
    std::vector<animation::SkinMatrix> palette(pose.size());
    animation::skinMatrices(skeleton.bindModelFromJoint, pose, palette);
    return palette;
}

}  // namespace

TEST_CASE("the bounds of a posed character hold every skinned vertex") {
    const animation::Character biped = test::makeBiped();
    const std::vector<BoundingSphere> joints = jointBounds(biped);
    Random random(11);
    const RigidTransform place{glm::normalize(quat(0.3F, 0.1F, 0.9F, -0.2F)), vec3(3, 1, -2)};
    for (int i = 0; i < 20; ++i) {
        const auto palette = randomPalette(biped.skeleton, random);
        const BoundingSphere sphere = posedBounds(joints, palette, place);
        std::vector<vec3> positions(biped.meshes[0].positions.size());
        animation::skinVertices(biped.meshes[0], palette, positions, {});
        float farthest = 0.0F;
        for (const vec3& position : positions)
            farthest = std::max(farthest, glm::length(place * position - sphere.center));
        CHECK(farthest <= sphere.radius);
        CHECK(farthest > 0.5F * sphere.radius);
    }
}

TEST_CASE("the sphere around two spheres touches both") {
    const BoundingSphere a{vec3(0), 1.0F};
    const BoundingSphere b{vec3(4, 0, 0), 0.5F};
    const BoundingSphere both = enclosing(a, b);
    CHECK(both.radius == Approx(2.75F));
    CHECK(both.center.x == Approx(1.75F));
    CHECK(enclosing(a, {vec3(0.2F), 0.1F}).radius == Approx(1.0F));
    CHECK(enclosing({}, b).radius == Approx(0.5F));
    CHECK(enclosing({}, {}).empty());
}

TEST_CASE("spheres outside the picture are told from those that touch it") {
    Camera camera;
    camera.target = vec3(0);
    camera.distance = 5.0F;
    camera.yaw = 0.0F;
    camera.pitch = 0.0F;
    const mat4 clip = clipFromWorld(camera, 1.5F);
    CHECK(mayBeSeen({vec3(0), 0.5F}, clip));
    CHECK_FALSE(mayBeSeen({vec3(0, 0, 8), 0.5F}, clip));
    CHECK_FALSE(mayBeSeen({vec3(10, 0, 0), 0.5F}, clip));
    CHECK(mayBeSeen({vec3(10, 0, 0), 9.0F}, clip));
    CHECK_FALSE(mayBeSeen({}, clip));
}

TEST_CASE("the shadow map holds all casters and moves by whole texels only") {
    Camera camera;
    const vec3 sun(0.3F, 0.9F, 0.2F);
    const ShadowFit first = fitShadow({vec3(0, 1, 0), 1.3F}, sun, camera, 2048);
    for (int i = 1; i < 40; ++i) {
        const vec3 moved = vec3(0, 1, 0) + 0.0137F * static_cast<float>(i) * vec3(1, 0.3F, -0.7F);
        const ShadowFit fit = fitShadow({moved, 1.3F}, sun, camera, 2048);
        CHECK(fit.metresPerTexel == first.metresPerTexel);
        const vec4 center = fit.lightFromWorld * vec4(moved, 1.0F);
        const float reach = 1.3F * 2.0F / (fit.metresPerTexel * 2048.0F);
        CHECK(std::abs(center.x) + reach <= 1.0F);
        CHECK(std::abs(center.y) + reach <= 1.0F);
        // The same world point lies at the same place inside its texel.
        const vec4 shift = (fit.lightFromWorld * vec4(0, 0, 0, 1) - first.lightFromWorld * vec4(0, 0, 0, 1)) * 1024.0F;
        CHECK(std::abs(shift.x - std::round(shift.x)) < 0.01F);
        CHECK(std::abs(shift.y - std::round(shift.y)) < 0.01F);
    }
}
