#include "animation/retarget/retargeter.hpp"

#include <glm/geometric.hpp>

#include "animation/pose.hpp"
#include "support/catch.hpp"
#include "support/counting_new.hpp"
#include "walking_biped.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

constexpr std::array kBonesToTest{
    std::array{Role::leftUpperArm, Role::leftLowerArm},   std::array{Role::leftLowerArm, Role::leftHand},
    std::array{Role::rightUpperArm, Role::rightLowerArm}, std::array{Role::rightLowerArm, Role::rightHand},
    std::array{Role::leftUpperLeg, Role::leftLowerLeg},   std::array{Role::leftLowerLeg, Role::leftFoot},
    std::array{Role::rightUpperLeg, Role::rightLowerLeg}, std::array{Role::rightLowerLeg, Role::rightFoot}};

test::HumanoidSpec oddSpec() {
    test::HumanoidSpec spec;
    spec.armDropDeg = 50.0F;
    spec.elbowBendDeg = 20.0F;
    spec.modelFromStandard = glm::angleAxis(kPi / 2, vec3(1, 0, 0)) * glm::angleAxis(2.0F, vec3(0, 1, 0));
    spec.scale = 0.01F;
    spec.axesSeed = 9;
    spec.twistJoints = true;
    spec.fingers = true;
    spec.trunkJoints = 5;
    spec.shoulders = false;
    return spec;
}

float worstDirection(const test::TestHumanoid& source, std::span<const RigidTransform> a,
                     const test::TestHumanoid& target, std::span<const RigidTransform> b) {
    float worst = 0.0F;
    for (const auto& [from, to] : kBonesToTest) {
        const float cosine = glm::dot(boneDirection(source, a, from, to), boneDirection(target, b, from, to));
        worst = std::max(worst, degrees(std::acos(std::clamp(cosine, -1.0F, 1.0F))));
    }
    return worst;
}

float turnOf(const test::TestHumanoid& humanoid, std::span<const RigidTransform> pose, int joint) {
    const RigidTransform now = modelFrameOf(humanoid.character.skeleton, pose, joint);
    const quat bind = humanoid.character.skeleton.bindModelFromJoint[joint].rotation;
    return degrees(glm::length(rotationVector(now.rotation * glm::conjugate(bind))));
}

}  // namespace

TEST_CASE("skin above the hips and beside the figure goes along, other such joints stay") {
    const test::TestHumanoid source = test::makeHumanoid({});
    test::TestHumanoid target = test::makeHumanoid({});
    Skeleton& skeleton = target.character.skeleton;
    const int head = target.map.jointOf(Role::head);
    const int first = skeleton.jointCount();
    // A control without skin, and a hat.
    for (const char* name : {"control", "hat"}) {
        skeleton.names.emplace_back(name);
        skeleton.parents.push_back(kNoJoint);
        RigidTransform place = skeleton.bindModelFromJoint[head];
        place.translation.y += 0.1F;
        skeleton.bindModelFromJoint.push_back(place);
        skeleton.nodeParentFromJoint.push_back(place);
    }
    SkinnedMesh hat;
    hat.positions = {skeleton.bindModelFromJoint[first + 1].translation};
    hat.joints = {{static_cast<std::uint16_t>(first + 1), 0, 0, 0}};
    hat.weights = {{1, 0, 0, 0}};
    target.character.meshes.push_back(hat);
    auto retargeter = Retargeter::make(source.character, source.map, target.character, target.map);
    REQUIRE(retargeter.ok());
    std::vector<RigidTransform> pose(source.character.skeleton.nodeParentFromJoint);
    test::turnInStandard(source, Role::spine, glm::angleAxis(0.6F, vec3(1, 0, 0)), pose);
    std::vector<RigidTransform> out(static_cast<std::size_t>(skeleton.jointCount()));
    retargeter.value().pose(pose, {}, out);
    const RigidTransform now = modelFrameOf(skeleton, out, head);
    const RigidTransform headFromHat =
        inverse(skeleton.bindModelFromJoint[head]) * skeleton.bindModelFromJoint[first + 1];
    CHECK(glm::distance(out[first + 1].translation, (now * headFromHat).translation) < 1e-4F);
    CHECK(glm::distance(out[first + 1].translation, skeleton.bindModelFromJoint[first + 1].translation) > 0.05F);
    CHECK(glm::distance(out[first].translation, skeleton.bindModelFromJoint[first].translation) < 1e-5F);
}

TEST_CASE("a figure's clip on itself is the clip") {
    const test::TestHumanoid humanoid = test::makeHumanoid({});
    const Clip walk = test::makeWalk(humanoid);
    auto retargeter = Retargeter::make(humanoid.character, humanoid.map, humanoid.character, humanoid.map);
    REQUIRE(retargeter);
    CHECK(retargeter.value().scale() == 1.0F);
    std::vector<RigidTransform> pose(humanoid.character.skeleton.parents.size());
    for (int frame = 0; frame < walk.frameCount; frame += 7) {
        const auto source = test::frameOf(walk, frame);
        retargeter.value().pose(source, {}, pose);
        for (std::size_t joint = 0; joint < pose.size(); ++joint) {
            CHECK(glm::distance(pose[joint].translation, source[joint].translation) < 1e-4F);
            CHECK(glm::length(rotationVector(glm::conjugate(pose[joint].rotation) * source[joint].rotation)) < 2e-3F);
        }
    }
}

TEST_CASE("limbs point as the source's on a rig of other axes, bind pose, up direction and unit, there and back") {
    const test::TestHumanoid plain = test::makeHumanoid({});
    const test::TestHumanoid odd = test::makeHumanoid(oddSpec());
    const Clip walk = test::makeWalk(plain);
    auto there = Retargeter::make(plain.character, plain.map, odd.character, odd.map);
    auto back = Retargeter::make(odd.character, odd.map, plain.character, plain.map);
    REQUIRE(there);
    REQUIRE(back);
    CHECK(there.value().scale() == Approx(0.01F).epsilon(1e-3));
    std::vector<RigidTransform> pose(odd.character.skeleton.parents.size());
    std::vector<RigidTransform> again(plain.character.skeleton.parents.size());
    for (int frame = 0; frame < walk.frameCount; frame += 5) {
        const auto source = test::frameOf(walk, frame);
        there.value().pose(source, {}, pose);
        CHECK(worstDirection(plain, source, odd, pose) < 0.3F);
        // The middle of the hips goes along in proportion.
        const vec3 hips = odd.map.standardFromModel * pose[0].translation;
        CHECK(hips.z == Approx(0.01F * source[0].translation.z).margin(2e-4));
        back.value().pose(pose, {}, again);
        CHECK(worstDirection(plain, source, plain, again) < 0.3F);
        CHECK(glm::distance(again[0].translation, source[0].translation) < 0.02F);
    }
}

TEST_CASE("the trunk's turn is spread over as many joints as the target has") {
    const test::TestHumanoid plain = test::makeHumanoid({});
    test::HumanoidSpec spec;
    spec.trunkJoints = 6;
    const test::TestHumanoid many = test::makeHumanoid(spec);
    auto retargeter = Retargeter::make(plain.character, plain.map, many.character, many.map);
    REQUIRE(retargeter);
    std::vector<RigidTransform> source = plain.character.skeleton.nodeParentFromJoint;
    const quat turn = glm::angleAxis(radians(20.0F), vec3(0, 1, 0));
    test::turnInStandard(plain, Role::spine, turn, source);
    test::turnInStandard(plain, Role::chest, turn, source);
    std::vector<RigidTransform> pose(many.character.skeleton.parents.size());
    retargeter.value().pose(source, {}, pose);
    float last = 0.0F;
    for (int joint = many.map.jointOf(Role::spine); joint <= many.map.jointOf(Role::chest); ++joint) {
        const float turned = turnOf(many, pose, joint);
        CHECK(turned >= last - 0.1F);
        CHECK(turned - last < 21.0F);
        last = turned;
    }
    CHECK(last == Approx(40.0F).margin(0.5));
    CHECK(turnOf(many, pose, many.map.jointOf(Role::hips)) < 0.1F);
}

TEST_CASE("a joint within the forearm takes half of the hand's twist, and fingers curl along") {
    test::HumanoidSpec from;
    from.fingers = true;
    const test::TestHumanoid source = test::makeHumanoid(from);
    const test::TestHumanoid target = test::makeHumanoid(oddSpec());
    auto retargeter = Retargeter::make(source.character, source.map, target.character, target.map);
    REQUIRE(retargeter);
    const Skeleton& skeleton = target.character.skeleton;
    std::vector<RigidTransform> bind = source.character.skeleton.nodeParentFromJoint;
    std::vector<RigidTransform> plainPose(skeleton.parents.size());
    std::vector<RigidTransform> turnedPose(skeleton.parents.size());
    retargeter.value().pose(bind, {}, plainPose);
    test::turnInStandard(source, Role::leftHand, glm::angleAxis(radians(60.0F), vec3(1, 0, 0)), bind);
    const int index = findJoint(source.character.skeleton,
                                "hips/spine/between/chest/leftShoulder/leftUpperArm/"
                                "leftLowerArm/leftHand/IndexProximal");
    REQUIRE(index != kNoJoint);
    bind[index].rotation = bind[index].rotation * glm::angleAxis(radians(40.0F), vec3(0, 0, -1));
    retargeter.value().pose(bind, {}, turnedPose);
    const auto turned = [&](int joint) {
        const quat before = modelFrameOf(skeleton, plainPose, joint).rotation;
        const quat after = modelFrameOf(skeleton, turnedPose, joint).rotation;
        return degrees(glm::length(rotationVector(after * glm::conjugate(before))));
    };
    const int forearm = target.map.jointOf(Role::leftLowerArm);
    const int hand = target.map.jointOf(Role::leftHand);
    const int twist = skeleton.parents[hand];
    REQUIRE(skeleton.names[twist] == "twist");
    CHECK(turned(forearm) < 0.2F);
    CHECK(turned(twist) == Approx(30.0F).margin(0.5));
    CHECK(turned(hand) == Approx(60.0F).margin(0.5));
    int targetIndex = kNoJoint;
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        if (skeleton.parents[joint] == hand && skeleton.names[joint] == "IndexProximal") targetIndex = joint;
    }
    REQUIRE(targetIndex != kNoJoint);
    const quat local = glm::conjugate(plainPose[targetIndex].rotation) * turnedPose[targetIndex].rotation;
    CHECK(degrees(glm::length(rotationVector(local))) == Approx(40.0F).margin(0.5));
}

TEST_CASE("a foot below a root of its own stays on its leg") {
    const test::TestHumanoid plain = test::makeHumanoid({});
    test::TestHumanoid apart = test::makeHumanoid({});
    Skeleton& skeleton = apart.character.skeleton;
    // The foot hangs on nothing, as on IK rigs.
    skeleton.parents[apart.map.jointOf(Role::leftFoot)] = kNoJoint;
    modelToLocal(skeleton, skeleton.bindModelFromJoint, skeleton.nodeParentFromJoint);
    const Clip walk = test::makeWalk(plain);
    auto retargeter = Retargeter::make(plain.character, plain.map, apart.character, apart.map);
    REQUIRE(retargeter);
    std::vector<RigidTransform> pose(skeleton.parents.size());
    for (const int frame : {10, 25}) {
        retargeter.value().pose(test::frameOf(walk, frame), {}, pose);
        CHECK(worstDirection(plain, test::frameOf(walk, frame), apart, pose) < 0.3F);
    }
}

TEST_CASE("retargeting a pose allocates nothing") {
    const test::TestHumanoid plain = test::makeHumanoid({});
    const test::TestHumanoid odd = test::makeHumanoid(oddSpec());
    const Clip walk = test::makeWalk(plain);
    auto retargeter = Retargeter::make(plain.character, plain.map, odd.character, odd.map);
    REQUIRE(retargeter);
    std::vector<RigidTransform> pose(odd.character.skeleton.parents.size());
    FootShift shift;
    shift.feet[0] = vec3(0.001F, 0.001F, 0);
    const std::size_t before = test::allocationCount();
    retargeter.value().pose(test::frameOf(walk, 3), {}, shift, pose);
    CHECK(test::allocationCount() == before);
}
