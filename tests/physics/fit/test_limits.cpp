#include "physics/fit/limits.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "animation/pose.hpp"
#include "core/random.hpp"
#include "core/swing_twist.hpp"
#include "physics/fit/fit_ragdoll.hpp"
#include "physics/fit/rebind.hpp"
#include "physics/profile/joint_range.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::physics;

namespace {

struct Bend {
    const char* joint;
    vec3 axis;
    float degrees;
};

struct BindPose {
    const char* name;
    std::vector<Bend> bends;
};

const std::vector<BindPose>& bindPoses() {
    static const std::vector<BindPose> poses = {
        {"T-pose", {}},
        {"A-pose", {{"leftUpperArm", {0, 0, 1}, -45}, {"rightUpperArm", {0, 0, 1}, 45}}},
        {"arms down", {{"leftUpperArm", {0, 0, 1}, -85}, {"rightUpperArm", {0, 0, 1}, 85}}},
        {"bent knees",
         {{"leftUpperLeg", {1, 0, 0}, -40},
          {"leftLowerLeg", {1, 0, 0}, 50},
          {"leftFoot", {1, 0, 0}, -10},
          {"rightUpperLeg", {1, 0, 0}, -40},
          {"rightLowerLeg", {1, 0, 0}, 50},
          {"rightFoot", {1, 0, 0}, -10}}},
        {"bent elbows", {{"leftLowerArm", {0, 1, 0}, -60}, {"rightLowerArm", {0, 1, 0}, 60}}},
    };
    return poses;
}

// The biped with its bind pose changed by rotating joints, the skin carried along; local axes are scrambled, so that
// nothing can lean on them.
animation::Character posedBiped(const BindPose& pose) {
    animation::Character biped = test::makeBiped();
    animation::Skeleton& skeleton = biped.skeleton;
    std::vector<RigidTransform> local(skeleton.parents.size());
    animation::modelToLocal(skeleton, skeleton.bindModelFromJoint, local);
    for (const Bend& bend : pose.bends) {
        const int joint = findJoint(skeleton, bend.joint);
        local[joint].rotation = glm::angleAxis(radians(bend.degrees), bend.axis) * local[joint].rotation;
    }
    std::vector<RigidTransform> posed(local.size());
    animation::localToModel(skeleton, local, posed);
    for (animation::SkinnedMesh& mesh : biped.meshes) {
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            const int joint = mesh.joints[v][0];
            mesh.positions[v] = posed[joint] * (inverse(skeleton.bindModelFromJoint[joint]) * mesh.positions[v]);
        }
    }
    Random random(7);
    for (RigidTransform& frame : posed) {
        frame.rotation = glm::normalize(quat(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), 1));
    }
    skeleton.bindModelFromJoint = posed;
    animation::modelToLocal(skeleton, posed, skeleton.nodeParentFromJoint);
    return biped;
}

std::vector<RigidTransform> bindBodies(const animation::Character& character, const RagdollProfile& profile) {
    std::vector<RigidTransform> bodies;
    for (const BodyProfile& body : profile.bodies) {
        const int joint = findJoint(character.skeleton, body.joint);
        bodies.push_back(character.skeleton.bindModelFromJoint[joint] * body.jointFromBody);
    }
    return bodies;
}

quat relativeRotation(const ConstraintProfile& constraint, const std::vector<RigidTransform>& bodies) {
    return glm::conjugate(bodies[constraint.parent].rotation * constraint.parentFromFrame.rotation) *
           (bodies[constraint.child].rotation * constraint.childFromFrame.rotation);
}

float hingeAngle(const ConstraintProfile& constraint, const std::vector<RigidTransform>& bodies) {
    const quat q = relativeRotation(constraint, bodies);
    return std::remainder(2.0F * std::atan2(q.z, q.w), 2.0F * kPi);
}

}  // namespace

TEST_CASE("swing and twist put together give the rotation back") {
    Random random(3);
    for (int i = 0; i < 200; ++i) {
        const quat q = glm::normalize(
            quat(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
        const SwingTwist parts = swingTwist(q);
        CHECK(parts.swing.x == 0.0F);
        CHECK(std::abs(glm::dot(rotationOf(parts), q)) == Approx(1.0).margin(1e-4));
    }
}

TEST_CASE("any bind pose of the biped gives the same anatomical limits and lies inside them") {
    const animation::Character reference = posedBiped(bindPoses()[0]);
    const RagdollProfile expected = fitRagdoll(reference, test::mapOfBiped(reference)).value();
    for (const BindPose& pose : bindPoses()) {
        INFO(pose.name);
        const animation::Character biped = posedBiped(pose);
        const RagdollProfile profile = fitRagdoll(biped, test::mapOfBiped(biped)).value();
        CHECK(profile.notes.empty());
        const std::vector<RigidTransform> bodies = bindBodies(biped, profile);
        for (std::size_t i = 0; i < profile.constraints.size(); ++i) {
            const ConstraintProfile& constraint = profile.constraints[i];
            const ConstraintProfile& same = expected.constraints[i];
            INFO(profile.bodies[constraint.child].name);
            CHECK(constraint.hinge.lower == same.hinge.lower);
            CHECK(constraint.hinge.upper == same.hinge.upper);
            CHECK(constraint.cone.swingY == same.cone.swingY);
            CHECK(constraint.cone.swingZ == same.cone.swingZ);
            CHECK(constraint.cone.twist == same.cone.twist);
            if (constraint.kind == ConstraintProfile::Kind::hinge) {
                CHECK(hingeAngle(constraint, bodies) > constraint.hinge.lower);
                CHECK(hingeAngle(constraint, bodies) < constraint.hinge.upper);
            } else {
                const SwingTwist parts = swingTwist(relativeRotation(constraint, bodies));
                CHECK(std::hypot(parts.swing.y / constraint.cone.swingY, parts.swing.z / constraint.cone.swingZ) < 1);
                CHECK(std::abs(parts.twist) < constraint.cone.twist);
            }
        }
    }
}

TEST_CASE("the angle of a hinge in the bind pose is the limb's own bend from the middle of its range") {
    for (const BindPose& pose : bindPoses()) {
        INFO(pose.name);
        const animation::Character biped = posedBiped(pose);
        const RagdollProfile profile = fitRagdoll(biped, test::mapOfBiped(biped)).value();
        const std::vector<RigidTransform> bodies = bindBodies(biped, profile);
        const auto bend = [&](Role role) {
            return degrees(hingeAngle(profile.constraints[bodyOf(profile, role) - 1], bodies));
        };
        const float knee = std::string(pose.name) == "bent knees" ? 50.0F : 0.0F;
        const float elbow = std::string(pose.name) == "bent elbows" ? 60.0F : 0.0F;
        for (const Role role : {Role::leftLowerLeg, Role::rightLowerLeg})
            CHECK(bend(role) == Approx(knee - 65.0F).margin(0.1));
        for (const Role role : {Role::leftLowerArm, Role::rightLowerArm})
            CHECK(bend(role) == Approx(elbow - 72.5F).margin(0.1));
    }
}

TEST_CASE("a bind pose beyond the anatomy widens the limit and says by how much") {
    const BindPose reversed{"knee bent forward", {{"leftLowerLeg", {1, 0, 0}, -25}}};
    const animation::Character biped = posedBiped(reversed);
    const RagdollProfile profile = fitRagdoll(biped, test::mapOfBiped(biped)).value();
    REQUIRE(profile.notes.size() == 1);
    CHECK(profile.notes[0].find("leftLowerLeg: hinge widened by 22.0 degrees") != std::string::npos);
    const ConstraintProfile& knee = profile.constraints[bodyOf(profile, Role::leftLowerLeg) - 1];
    CHECK(degrees(knee.hinge.lower) == Approx(-92.0).margin(0.1));
}

TEST_CASE("a bind pose far beyond the anatomy is held by a cone that does not reach round the back") {
    // A foot that a clip left turned back, an arm wound up behind, a wrist bent sideways: all about two axes.
    const BindPose poses[] = {{"foot back", {{"leftFoot", {1, 0, 0}, 110}}},
                              {"foot askew", {{"leftFoot", glm::normalize(vec3(1, 0.6F, 0)), 125}}},
                              {"arm behind", {{"rightUpperArm", glm::normalize(vec3(0, 1, 0.4F)), 140}}},
                              {"hand askew", {{"rightHand", glm::normalize(vec3(0.2F, 1, 0.3F)), 150}}},
                              {"hand folded back", {{"leftHand", glm::normalize(vec3(0.1F, 0.2F, 1)), 172}}}};
    for (const BindPose& pose : poses) {
        INFO(pose.name);
        const animation::Character biped = posedBiped(pose);
        const RagdollProfile profile = fitRagdoll(biped, test::mapOfBiped(biped)).value();
        REQUIRE(profile.notes.size() == 1);
        INFO(profile.notes[0]);
        const auto shapes = shapesInBindPose(profile, biped.skeleton);
        const std::vector<RigidTransform> bodies = bindBodies(biped, profile);
        for (const ConstraintProfile& constraint : profile.constraints) {
            if (constraint.kind == ConstraintProfile::Kind::hinge) continue;
            const SwingTwist parts = swingTwist(relativeRotation(constraint, bodies));
            CHECK(std::hypot(parts.swing.y / constraint.cone.swingY, parts.swing.z / constraint.cone.swingZ) < 1);
            const JointRange range = jointRange(
                constraint, {shapes[constraint.parent].standardFromBody, shapes[constraint.child].standardFromBody});
            for (const AngleSpan& span : {range.flexion, range.side})
                CHECK(degrees(std::max(-span.low, span.high)) < 230.0F);
        }
    }
}

TEST_CASE("no bind pose makes a cone that reaches round the back") {
    // Wrists, ankles, shoulders and hips, bent about all axes by all angles.
    for (const ConeTwistLimits& cone : {ConeTwistLimits{radians(25.0F), radians(75.0F), radians(80.0F)},
                                        ConeTwistLimits{radians(20.0F), radians(35.0F), radians(20.0F)},
                                        ConeTwistLimits{radians(85.0F), radians(85.0F), radians(70.0F)}}) {
        float furthest = 0.0F;
        for (int degree = 5; degree < 180; degree += 5) {
            for (int around = 0; around < 360; around += 10) {
                const float angle = radians(static_cast<float>(degree));
                const float way = radians(static_cast<float>(around));
                const SwingTwist pose{angle * vec3(0, std::cos(way), std::sin(way)), 0.0F};
                ConstraintProfile constraint;
                constraint.kind = ConstraintProfile::Kind::coneTwist;
                constraint.cone = cone;
                const RigidTransform parent;
                const RigidTransform child{rotationOf(pose), vec3(0)};
                static_cast<void>(widenToHold(constraint, parent, child, "hand"));
                const SwingTwist held = swingTwist(glm::conjugate(constraint.parentFromFrame.rotation) *
                                                   child.rotation * constraint.childFromFrame.rotation);
                INFO(degree << " degrees towards " << around);
                CHECK(std::hypot(held.swing.y / constraint.cone.swingY, held.swing.z / constraint.cone.swingZ) < 1);
                furthest = std::max({furthest, constraint.cone.swingY + std::abs(held.swing.y),
                                     constraint.cone.swingZ + std::abs(held.swing.z)});
            }
        }
        CHECK(degrees(furthest) < 230.0F);
    }
}

TEST_CASE("a twist nearly half a turn from a man's is counted from the bind pose") {
    // A walker's knees, which bend forwards.
    const BindPose pose{"walker", {{"leftLowerLeg", {1, 0, 0}, -60}, {"rightLowerLeg", {1, 0, 0}, -60}}};
    const animation::Character biped = posedBiped(pose);
    const RagdollProfile profile = fitRagdoll(biped, test::mapOfBiped(biped)).value();
    const auto shapes = shapesInBindPose(profile, biped.skeleton);
    const std::vector<RigidTransform> bodies = bindBodies(biped, profile);
    bool told = false;
    for (const std::string& note : profile.notes)
        told = told || note.find("twist is counted from the bind pose") != std::string::npos;
    CHECK(told);
    for (const ConstraintProfile& constraint : profile.constraints) {
        if (constraint.kind == ConstraintProfile::Kind::hinge) continue;
        INFO(profile.bodies[constraint.child].name);
        CHECK(std::abs(swingTwist(relativeRotation(constraint, bodies)).twist) < constraint.cone.twist);
        const JointRange range = jointRange(
            constraint, {shapes[constraint.parent].standardFromBody, shapes[constraint.child].standardFromBody});
        for (const AngleSpan& span : {range.flexion, range.side, range.twist})
            CHECK(degrees(std::max(-span.low, span.high)) < 230.0F);
    }
}

TEST_CASE("a limb that is bent far is flexed, whichever way its upper part is turned") {
    // A forearm behind the back, a shin crossed over the other leg: the shoulder and the hip are turned, no elbow and
    // no knee is broken.
    const BindPose poses[] = {{"behind the back", {{"leftLowerArm", {0, 1, 0}, 90}}},
                              {"crossed", {{"rightLowerLeg", {0, 0, 1}, -80}}}};
    for (const BindPose& pose : poses) {
        INFO(pose.name);
        const animation::Character biped = posedBiped(pose);
        const RagdollProfile profile = fitRagdoll(biped, test::mapOfBiped(biped)).value();
        for (const std::string& note : profile.notes) {
            INFO(note);
            CHECK(note.find("hinge widened") == std::string::npos);
        }
        const Role role = std::string(pose.name) == "crossed" ? Role::rightLowerLeg : Role::leftLowerArm;
        const float bend = std::string(pose.name) == "crossed" ? 80.0F - 65.0F : 90.0F - 72.5F;
        CHECK(degrees(hingeAngle(profile.constraints[bodyOf(profile, role) - 1], bindBodies(biped, profile))) ==
              Approx(bend).margin(0.1));
    }
}
