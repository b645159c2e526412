#include "physics/profile/joint_range.hpp"

#include <glm/geometric.hpp>

#include "animation/humanoid/map_humanoid.hpp"
#include "core/swing_twist.hpp"
#include "physics/fit/fit_ragdoll.hpp"
#include "physics/profile/constraint_state.hpp"
#include "physics/profile/within_limits.hpp"
#include "physics/rig/rig.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

struct Fitted {
    animation::Character character = test::makeBiped();
    animation::HumanoidMap map = animation::mapHumanoid(character);
    RagdollProfile profile = fitRagdoll(character, map).value();
    Rig rig = bindRig(profile, character.skeleton).value();

    ConstraintProfile& constraint(Role role) { return profile.constraints[bodyOf(profile, role) - 1]; }
    BindFrames bind(Role role) {
        const ConstraintProfile& one = constraint(role);
        return {rig.bindModelFromBody[one.parent], rig.bindModelFromBody[one.child]};
    }
};

// The child turned about the constraint's anchor by a rotation in the parent's constraint frame, on top of `relative`.
BindFrames posed(const ConstraintProfile& constraint, const BindFrames& bind, const quat& relative) {
    BindFrames pose = bind;
    const quat childFrame = bind.fromParent.rotation * constraint.parentFromFrame.rotation * relative;
    pose.fromChild.rotation = childFrame * glm::conjugate(constraint.childFromFrame.rotation);
    return pose;
}

float violationOf(const ConstraintProfile& constraint, const BindFrames& pose) {
    return measureConstraint(constraint, pose.fromParent, pose.fromChild).violation;
}

bool near(const quat& a, const quat& b) {
    return std::abs(std::abs(glm::dot(a, b)) - 1.0F) < 1e-5F;
}

}  // namespace

TEST_CASE("a range that is read and set again changes nothing") {
    Fitted fitted;
    for (const ConstraintProfile& before : fitted.profile.constraints) {
        const BindFrames bind{fitted.rig.bindModelFromBody[before.parent], fitted.rig.bindModelFromBody[before.child]};
        ConstraintProfile after = before;
        setJointRange(after, jointRange(before, bind), bind);
        CHECK(near(after.parentFromFrame.rotation, before.parentFromFrame.rotation));
        CHECK(after.hinge.upper == Approx(before.hinge.upper).margin(1e-5));
        CHECK(after.cone.swingZ == Approx(before.cone.swingZ).margin(1e-5));
        CHECK(after.cone.twist == Approx(before.cone.twist).margin(1e-5));
    }
}

TEST_CASE("a hip is allowed exactly the flexion that was asked for and no more") {
    Fitted fitted;
    ConstraintProfile& hip = fitted.constraint(Role::leftUpperLeg);
    const BindFrames bind = fitted.bind(Role::leftUpperLeg);
    JointRange range = jointRange(hip, bind);
    range.flexion = {radians(-20.0F), radians(70.0F)};
    setJointRange(hip, range, bind);
    const JointRange read = jointRange(hip, bind);
    CHECK(degrees(read.flexion.low) == Approx(-20.0F).margin(0.01));
    CHECK(degrees(read.flexion.high) == Approx(70.0F).margin(0.01));
    CHECK(degrees(read.side.high) == Approx(degrees(range.side.high)).margin(0.01));
    // From the middle of the range, along the axis of flexion.
    const float half = radians(45.0F);
    const auto flexed = [&](float angle) { return posed(hip, bind, glm::angleAxis(angle, vec3(0, 0, 1))); };
    CHECK(violationOf(hip, flexed(half - radians(1.0F))) < 1e-4F);
    CHECK(degrees(violationOf(hip, flexed(half + radians(5.0F)))) == Approx(5.0F).margin(0.1));
    CHECK(violationOf(hip, bind) < 1e-4F);
}

TEST_CASE("a hinge whose range leaves its neutral pose takes that along and stays valid") {
    Fitted fitted;
    ConstraintProfile& knee = fitted.constraint(Role::leftLowerLeg);
    const BindFrames bind = fitted.bind(Role::leftLowerLeg);
    setJointRange(knee, {{radians(-160.0F), radians(-120.0F)}, {}, {}}, bind);
    CHECK(knee.hinge.lower <= 0.0F);
    CHECK(knee.hinge.upper >= 0.0F);
    const JointRange read = jointRange(knee, bind);
    CHECK(degrees(read.flexion.low) == Approx(-160.0F).margin(0.05));
    CHECK(degrees(read.flexion.high) == Approx(-120.0F).margin(0.05));
    CHECK(validate(fitted.profile).empty());
}

TEST_CASE("a hinge becomes a cone and a hinge again with the same flexion about the same axis") {
    Fitted fitted;
    ConstraintProfile& knee = fitted.constraint(Role::leftLowerLeg);
    const BindFrames bind = fitted.bind(Role::leftLowerLeg);
    const ConstraintProfile before = knee;
    const JointRange range = jointRange(knee, bind);
    changeKind(knee, ConstraintProfile::Kind::coneTwist, bind);
    CHECK(knee.kind == ConstraintProfile::Kind::coneTwist);
    CHECK(jointRange(knee, bind).flexion.high == Approx(range.flexion.high).margin(1e-4));
    CHECK(violationOf(knee, bind) < 1e-4F);
    CHECK(degrees(knee.cone.twist) == Approx(10.0F));
    changeKind(knee, ConstraintProfile::Kind::hinge, bind);
    CHECK(jointRange(knee, bind).flexion.low == Approx(range.flexion.low).margin(1e-4));
    CHECK(jointRange(knee, bind).flexion.high == Approx(range.flexion.high).margin(1e-4));
    const vec3 axis = knee.childFromFrame.rotation * vec3(0, 0, 1);
    CHECK(glm::dot(axis, before.childFromFrame.rotation * vec3(0, 0, 1)) > 0.9999F);
}

TEST_CASE("a shoulder made a hinge holds the bind pose and bends about the flexion axis on the arm") {
    Fitted fitted;
    ConstraintProfile& shoulder = fitted.constraint(Role::leftUpperArm);
    const BindFrames bind = fitted.bind(Role::leftUpperArm);
    const vec3 axis = shoulder.childFromFrame.rotation * vec3(0, 0, 1);
    changeKind(shoulder, ConstraintProfile::Kind::hinge, bind);
    CHECK(violationOf(shoulder, bind) < 1e-3F);
    CHECK(glm::distance(shoulder.childFromFrame.rotation * vec3(0, 0, 1), axis) < 1e-4F);
    // In the bind pose both frames have the same axis.
    const vec3 onParent = bind.fromParent.rotation * shoulder.parentFromFrame.rotation * vec3(0, 0, 1);
    const vec3 onChild = bind.fromChild.rotation * shoulder.childFromFrame.rotation * vec3(0, 0, 1);
    CHECK(glm::distance(onParent, onChild) < 1e-4F);
    CHECK(validate(fitted.profile).empty());
}

TEST_CASE("turning a frame moves its axes and keeps the neutral pose") {
    Fitted fitted;
    ConstraintProfile& elbow = fitted.constraint(Role::leftLowerArm);
    const BindFrames bind = fitted.bind(Role::leftLowerArm);
    const auto neutralChild = [&] {
        return bind.fromParent.rotation * elbow.parentFromFrame.rotation *
               glm::conjugate(elbow.childFromFrame.rotation);
    };
    const quat before = neutralChild();
    const vec3 axis = elbow.childFromFrame.rotation * vec3(0, 0, 1);
    turnFrames(elbow, glm::angleAxis(radians(90.0F), vec3(1, 0, 0)));
    CHECK(near(neutralChild(), before));
    CHECK(std::abs(glm::dot(elbow.childFromFrame.rotation * vec3(0, 0, 1), axis)) < 1e-4F);
}

TEST_CASE("a body that is moved leaves its constraints where they were") {
    Fitted fitted;
    const int shin = bodyOf(fitted.profile, Role::leftLowerLeg);
    const auto anchors = [&] {
        const Rig rig = bindRig(fitted.profile, fitted.character.skeleton).value();
        std::vector<RigidTransform> frames;
        for (const ConstraintProfile& c : fitted.profile.constraints) {
            frames.push_back(rig.bindModelFromBody[c.parent] * c.parentFromFrame);
            frames.push_back(rig.bindModelFromBody[c.child] * c.childFromFrame);
        }
        return frames;
    };
    const auto before = anchors();
    RigidTransform place = fitted.profile.bodies[shin].jointFromBody;
    place.translation += vec3(0.02F, 0.05F, -0.01F);
    place.rotation = glm::normalize(place.rotation * glm::angleAxis(0.4F, glm::normalize(vec3(1, 2, 3))));
    moveBody(fitted.profile, shin, place);
    const auto after = anchors();
    for (std::size_t i = 0; i < before.size(); ++i) {
        CHECK(glm::distance(before[i].translation, after[i].translation) < 1e-5F);
        CHECK(near(before[i].rotation, after[i].rotation));
    }
    CHECK(validate(fitted.profile).empty());
}

TEST_CASE("an edit of frames is found again and applied again") {
    Fitted fitted;
    const ConstraintProfile plain = fitted.constraint(Role::head);
    ConstraintProfile edited = plain;
    shiftNeutral(edited, glm::angleAxis(0.3F, vec3(0, 0, 1)));
    turnFrames(edited, glm::angleAxis(-0.7F, vec3(0, 1, 0)));
    const FrameEdit edit = frameEditBetween(plain, edited);
    CHECK_FALSE(isNone(edit));
    CHECK(isNone(frameEditBetween(plain, plain)));
    ConstraintProfile again = plain;
    applyFrameEdit(again, edit);
    CHECK(near(again.parentFromFrame.rotation, edited.parentFromFrame.rotation));
    CHECK(near(again.childFromFrame.rotation, edited.childFromFrame.rotation));
}

TEST_CASE("the two sides of the figure have mirrored ranges and swapped words") {
    Fitted fitted;
    const JointRange left = jointRange(fitted.constraint(Role::leftUpperLeg), fitted.bind(Role::leftUpperLeg));
    const JointRange right = jointRange(fitted.constraint(Role::rightUpperLeg), fitted.bind(Role::rightUpperLeg));
    const JointRange across = mirrored(left);
    CHECK(across.flexion.low == Approx(right.flexion.low).margin(0.02));
    CHECK(across.side.high == Approx(right.side.high).margin(0.02));
    CHECK(across.twist.low == Approx(right.twist.low).margin(0.02));
    CHECK(jointWords(Role::leftUpperLeg).side.high == "abduction");
    CHECK(jointWords(Role::rightUpperLeg).side.low == "abduction");
    // A hip abducts further than it adducts, on either side.
    CHECK(left.side.high > -left.side.low);
    CHECK(-right.side.low > right.side.high);
}

TEST_CASE("a spring rests in the same pose whatever becomes of its joint's limits, axes and kind") {
    Fitted fitted;
    ConstraintProfile& knee = fitted.constraint(Role::leftLowerLeg);
    ConstraintProfile& hip = fitted.constraint(Role::leftUpperLeg);
    const auto restOf = [](const ConstraintProfile& c) {  // the child's body in the parent's
        return c.parentFromFrame.rotation * c.spring.rest * glm::conjugate(c.childFromFrame.rotation);
    };
    const BindFrames kneeBind = fitted.bind(Role::leftLowerLeg);
    const BindFrames hipBind = fitted.bind(Role::leftUpperLeg);
    knee.spring = {5.0F, 1.0F, glm::angleAxis(radians(20.0F), vec3(0, 0, 1))};
    hip.spring = {5.0F, 1.0F, relativeFrame(hip, hipBind)};
    const quat kneeRest = restOf(knee);
    const quat hipRest = restOf(hip);
    changeKind(knee, ConstraintProfile::Kind::coneTwist, kneeBind);
    CHECK(near(restOf(knee), kneeRest));
    JointRange range = jointRange(hip, hipBind);
    range.flexion = {radians(-70.0F), radians(20.0F)};
    range.side = {radians(-5.0F), radians(60.0F)};
    setJointRange(hip, range, hipBind);
    turnFrames(hip, glm::angleAxis(radians(30.0F), glm::normalize(vec3(1, 2, 3))));
    CHECK(near(restOf(hip), hipRest));
    // Told from the bind pose it is no turn at all, and comes back from that.
    CHECK(near(springFromBind(hip, hipBind).rest, quat(1, 0, 0, 0)));
    ConstraintProfile other = fitted.constraint(Role::head);
    const JointSpring bent{3.0F, 2.0F, glm::angleAxis(radians(25.0F), vec3(0, 0, 1))};
    setSpringFromBind(other, bent, fitted.bind(Role::head));
    CHECK(near(springFromBind(other, fitted.bind(Role::head)).rest, bent.rest));
    CHECK(other.spring.damping == 2.0F);
}

TEST_CASE("a rotation beyond a joint's limits comes back on them, one within them as it is") {
    Fitted fitted;
    for (const Role role : {Role::leftHand, Role::leftUpperArm, Role::leftLowerLeg}) {
        const ConstraintProfile& joint = fitted.constraint(role);
        const BindFrames bind = fitted.bind(role);
        for (int i = 0; i < 27; ++i) {
            const vec3 turn(static_cast<float>(i % 3 - 1), static_cast<float>(i / 3 % 3 - 1),
                            static_cast<float>(i / 9 - 1));
            const float angle = glm::length(turn) * 0.9F;
            const quat relative = angle > 0.0F ? glm::angleAxis(angle, glm::normalize(turn)) : quat(1, 0, 0, 0);
            BindFrames pose = posed(joint, bind, relative);
            const bool was = violationOf(joint, pose) > 1e-3F;
            const quat before = glm::conjugate(pose.fromParent.rotation) * pose.fromChild.rotation;
            const quat after = withinLimits(joint, before);
            pose.fromChild.rotation = pose.fromParent.rotation * after;
            CHECK(violationOf(joint, pose) < 1e-3F);
            if (!was && joint.kind == ConstraintProfile::Kind::coneTwist)
                CHECK(std::abs(glm::dot(before, after)) > 1.0F - 1e-5F);
        }
    }
}
