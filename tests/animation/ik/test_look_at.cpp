#include "animation/ik/look_at.hpp"

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

/// The biped in its bind pose, looking along +Z.
struct Looker {
    Character biped = test::makeBiped();
    const Skeleton& skeleton = biped.skeleton;
    HumanoidMap map = test::mapOfBiped(biped);
    std::array<LookJoint, 2> joints{{{map.jointOf(Role::neck), 1.0F}, {map.jointOf(Role::head), 2.0F}}};
    LookAt look;
    std::vector<RigidTransform> rest{skeleton.parents.size()};

    Looker() {
        look.joints = joints;
        look.eyeInHead = vec3(0, 0.08F, 0.1F);
        modelToLocal(skeleton, skeleton.bindModelFromJoint, rest);
    }
    [[nodiscard]] vec3 eye(std::span<const RigidTransform> pose) const {
        return modelFrameOf(skeleton, pose, joints[1].joint) * look.eyeInHead;
    }
    [[nodiscard]] vec3 face(std::span<const RigidTransform> pose) const {
        return modelFrameOf(skeleton, pose, joints[1].joint).rotation * look.forwardInHead;
    }
};

vec3 directionAt(float yaw, float pitch) {
    return {std::sin(yaw) * std::cos(pitch), std::sin(pitch), std::cos(yaw) * std::cos(pitch)};
}

}  // namespace

TEST_CASE("the face points at what lies within its limits, near and far") {
    const Looker looker;
    float worst = 0.0F;
    for (const float distance : {0.6F, 2.0F, 50.0F}) {
        for (float yaw = -45.0F; yaw <= 45.0F; yaw += 15.0F) {
            for (float pitch = -20.0F; pitch <= 20.0F; pitch += 10.0F) {
                std::vector<RigidTransform> pose = looker.rest;
                const vec3 target = looker.eye(looker.rest) + directionAt(radians(yaw), radians(pitch)) * distance;
                worst = std::max(worst, solveLookAt(looker.skeleton, looker.look, target, pose));
                const vec3 way = glm::normalize(target - looker.eye(pose));
                CHECK(glm::dot(looker.face(pose), way) > std::cos(radians(2.0F)));
            }
        }
    }
    INFO(degrees(worst));
    CHECK(degrees(worst) < 2.0F);
}

TEST_CASE("the face stops at its limits, and looks ahead again when the target goes behind") {
    const Looker looker;
    const vec3 eye = looker.eye(looker.rest);
    float most = 0.0F;
    std::vector<RigidTransform> last;
    float worst = 0.0F;
    // Once around the figure, half a degree a step.
    for (float yaw = -180.0F; yaw <= 180.0F; yaw += 0.5F) {
        std::vector<RigidTransform> pose = looker.rest;
        solveLookAt(looker.skeleton, looker.look, eye + directionAt(radians(yaw), 0.1F) * 5.0F, pose);
        const vec3 face = looker.face(pose);
        most = std::max(most, std::abs(std::atan2(face.x, face.z)));
        if (!last.empty()) worst = std::max(worst, test::turnBetween(last, pose));
        last = pose;
        if (std::abs(yaw) > 179.9F) CHECK(face.z > 0.995F);
    }
    CHECK(most < looker.look.mostYaw + radians(0.5F));
    CHECK(most > looker.look.mostYaw - radians(12.0F));
    // Neck and head are two joints; between the limit and straight behind they come back faster than the target goes.
    CHECK(degrees(worst) < 2.0F);
}

TEST_CASE("half a look turns the head half-way, the neck by its share") {
    const Looker looker;
    const vec3 target = looker.eye(looker.rest) + directionAt(radians(40.0F), 0.0F) * 100.0F;
    std::vector<RigidTransform> pose = looker.rest;
    solveLookAt(looker.skeleton, looker.look, target, pose, 0.5F);
    const vec3 face = looker.face(pose);
    CHECK(degrees(std::atan2(face.x, face.z)) == Approx(20.0F).margin(0.3));
    const auto turned = [&](int joint) {
        return glm::length(rotationVector(glm::conjugate(looker.rest[joint].rotation) * pose[joint].rotation));
    };
    CHECK(turned(looker.joints[1].joint) == Approx(2.0F * turned(looker.joints[0].joint)).epsilon(0.05));
    pose = looker.rest;
    solveLookAt(looker.skeleton, looker.look, target, pose, 0.0F);
    CHECK(test::turnBetween(pose, looker.rest) < 1e-3F);
}

TEST_CASE("looking allocates nothing") {
    const Looker looker;
    std::vector<RigidTransform> pose = looker.rest;
    const std::size_t before = test::allocationCount();
    solveLookAt(looker.skeleton, looker.look, vec3(1, 1, 2), pose);
    CHECK(test::allocationCount() == before);
}
