#include "animation/ik/feet_on_ground.hpp"

#include <array>
#include <glm/geometric.hpp>

#include "animation/pose.hpp"
#include "random_chain.hpp"
#include "support/catch.hpp"
#include "support/counting_new.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

// The biped with a joint at the ball of each foot.
Character makeToedBiped() {
    Character biped = test::makeBiped();
    Skeleton& skeleton = biped.skeleton;
    for (const char* foot : {"leftFoot", "rightFoot"}) {
        const int joint = findJoint(skeleton, foot);
        const RigidTransform footFromBall{quat(1, 0, 0, 0), vec3(0, -0.06F, 0.14F)};
        skeleton.names.push_back(foot + std::string("Ball"));
        skeleton.parents.push_back(joint);
        skeleton.bindModelFromJoint.push_back(skeleton.bindModelFromJoint[joint] * footFromBall);
        skeleton.nodeParentFromJoint.push_back(footFromBall);
        skeleton.skinWeight.push_back(0.0F);
    }
    return biped;
}

/// The biped with its knees a little bent, on its soles.
struct Stander {
    Character biped = makeToedBiped();
    const Skeleton& skeleton = biped.skeleton;
    HumanoidMap map = test::mapOfBiped(biped);
    std::array<GroundLeg, 2> legs;
    GroundSettings settings;
    std::vector<RigidTransform> pose{skeleton.parents.size()};

    Stander() {
        modelToLocal(skeleton, skeleton.bindModelFromJoint, pose);
        settings.hips = map.jointOf(Role::hips);
        for (const bool left : {true, false}) {
            GroundLeg& leg = legs[left ? 0 : 1];
            leg.bones.upper = map.jointOf(left ? Role::leftUpperLeg : Role::rightUpperLeg);
            leg.bones.middle = map.jointOf(left ? Role::leftLowerLeg : Role::rightLowerLeg);
            leg.bones.end = map.jointOf(left ? Role::leftFoot : Role::rightFoot);
            leg.toes = findJoint(skeleton, left ? "leftFootBall" : "rightFootBall");
            leg.ankleHeight = skeleton.bindModelFromJoint[leg.bones.end].translation.y;
            pose[leg.bones.upper].rotation = glm::angleAxis(-0.25F, vec3(1, 0, 0));
            pose[leg.bones.middle].rotation = glm::angleAxis(0.5F, vec3(1, 0, 0));
            pose[leg.bones.end].rotation = glm::angleAxis(-0.25F, vec3(1, 0, 0));
        }
        // Back onto the soles.
        const float sunk = legs[0].ankleHeight - ankle(0).y;
        pose[settings.hips].translation.y += sunk;
    }
    [[nodiscard]] RigidTransform frame(int joint) const { return modelFrameOf(skeleton, pose, joint); }
    [[nodiscard]] vec3 ankle(int leg) const { return frame(legs[leg].bones.end).translation; }
    GroundedFeet place(const GroundQuery& ground, const RigidTransform& worldFromModel = {}) {
        return placeFeet(skeleton, legs, settings, worldFromModel, ground, pose);
    }
};

GroundQuery level(float height) {
    return [=](const vec3&) { return GroundHit{height, {0, 1, 0}}; };
}

}  // namespace

TEST_CASE("on the level floor feet stay where they are, and over nothing too") {
    const Stander before;
    Stander stander;
    const GroundedFeet placed = stander.place(level(0.0F));
    CHECK(placed.drop == Approx(0.0F).margin(1e-4));
    CHECK(test::turnBetween(before.pose, stander.pose) < radians(0.5F));
    stander.place([](const vec3&) { return std::nullopt; });
    CHECK(test::turnBetween(before.pose, stander.pose) < radians(0.5F));
}

TEST_CASE("the hips come down with the lower foot, and both soles stand on their stairs") {
    const Stander before;
    for (const float step : {0.1F, 0.2F}) {
        Stander stander;
        const GroundQuery stairs = [&](const vec3& point) {
            return GroundHit{point.x > 0.0F ? 0.0F : -step, {0, 1, 0}};
        };
        const GroundedFeet placed = stander.place(stairs);
        CHECK(placed.drop == Approx(step).margin(1e-4));
        CHECK(placed.errorM < 2e-3F);
        CHECK(stander.ankle(0).y == Approx(before.ankle(0).y).margin(2e-3));
        CHECK(stander.ankle(1).y == Approx(before.ankle(1).y - step).margin(2e-3));
        CHECK(test::stretchBetween(stander.skeleton, before.pose, stander.pose) < step + 1e-5F);
        // Soles stay level.
        const vec3 up = stander.frame(stander.legs[0].bones.end).rotation * vec3(0, 1, 0);
        CHECK(up.y > 0.9999F);
    }
}

TEST_CASE("soles lie on a slope, in whatever way the figure stands in the world") {
    for (const float slopeDeg : {-25.0F, 15.0F, 30.0F}) {
        const vec3 normal = glm::angleAxis(radians(slopeDeg), vec3(1, 0, 0)) * vec3(0, 1, 0);
        const vec3 origin(3, 1, -2);
        const GroundQuery slope = [&](const vec3& point) {
            const vec3 arm = point - origin;
            return GroundHit{origin.y - (arm.x * normal.x + arm.z * normal.z) / normal.y, normal};
        };
        Stander stander;
        const RigidTransform worldFromModel{glm::angleAxis(0.7F, vec3(0, 1, 0)), origin};
        stander.settings.floor = origin.y;
        const GroundedFeet placed = stander.place(slope, worldFromModel);
        CHECK(placed.errorM < 5e-3F);
        for (int leg = 0; leg < 2; ++leg) {
            const RigidTransform foot = worldFromModel * stander.frame(stander.legs[leg].bones.end);
            const vec3 up = foot.rotation * vec3(0, 1, 0);
            CHECK(glm::dot(up, normal) > std::cos(radians(1.5F)));
            const float over = glm::dot(foot.translation - origin, normal);
            CHECK(over == Approx(stander.legs[leg].ankleHeight).margin(6e-3));
        }
    }
}

TEST_CASE("a stair under the ball holds the foot up") {
    Stander stander;
    const float edge = stander.ankle(0).z + 0.05F;
    const GroundQuery stair = [&](const vec3& point) { return GroundHit{point.z > edge ? 0.1F : 0.0F, {0, 1, 0}}; };
    const float before = stander.ankle(0).y;
    stander.place(stair);
    CHECK(stander.ankle(0).y == Approx(before + 0.1F).margin(5e-3));
}

// 1 mm of the ground turns no joint by more than 1.5 degrees.
TEST_CASE("ground that rises and sinks moves the legs without a snap, down to where they are straight") {
    std::vector<RigidTransform> last;
    float worst = 0.0F;
    for (float step = -0.6F; step < 0.6F; step += 1e-3F) {
        Stander stander;
        stander.place([&](const vec3& point) { return GroundHit{point.x > 0.0F ? 0.0F : step, {0, 1, 0}}; });
        if (!last.empty()) worst = std::max(worst, test::turnBetween(last, stander.pose));
        last = stander.pose;
    }
    INFO(degrees(worst));
    CHECK(degrees(worst) < 1.5F);
}

TEST_CASE("placing feet allocates nothing") {
    Stander stander;
    const GroundQuery ground = level(0.05F);
    const std::size_t before = test::allocationCount();
    stander.place(ground);
    CHECK(test::allocationCount() == before);
}
