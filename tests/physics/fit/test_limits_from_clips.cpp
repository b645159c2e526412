#include "physics/fit/limits_from_clips.hpp"

#include <glm/geometric.hpp>

#include "physics/fit/fit_ragdoll.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::physics;
using animation::Character;

namespace {

struct FittedDoll {
    Character character;
    RagdollProfile profile;
    Rig rig;
};

// The biped with one clip that turns `joint` about `axis` from 0 to `angle`.
FittedDoll dollThatTurns(const std::string& joint, const vec3& axis, float angle) {
    FittedDoll doll;
    doll.character = test::makeBiped();
    animation::Clip clip{"turn", 30.0F, 11, {}, {}};
    const int turned = animation::findJoint(doll.character.skeleton, joint);
    for (int frame = 0; frame < clip.frameCount; ++frame) {
        std::vector<RigidTransform> pose = doll.character.skeleton.nodeParentFromJoint;
        pose[turned].rotation = glm::angleAxis(angle * static_cast<float>(frame) / 10.0F, axis) * pose[turned].rotation;
        clip.parentFromJoint.append(pose);
    }
    doll.character.clips.push_back(clip);
    auto profile = fitRagdoll(doll.character, test::mapOfBiped(doll.character));
    REQUIRE(profile);
    doll.profile = std::move(profile).value();
    auto rig = bindRig(doll.profile, doll.character.skeleton);
    REQUIRE(rig);
    doll.rig = std::move(rig).value();
    return doll;
}

const ConstraintProfile& constraintOf(const FittedDoll& doll, Role role) {
    return doll.profile.constraints[bodyOf(doll.profile, role) - 1];
}

}  // namespace

TEST_CASE("a knee that a clip bends the wrong way gets room for just that, with a margin") {
    // About +X the shin swings forwards: 40 degrees of hyperextension, which the anatomy forbids.
    FittedDoll doll = dollThatTurns("leftLowerLeg", {1, 0, 0}, -radians(40));
    const HingeLimits before = constraintOf(doll, Role::leftLowerLeg).hinge;
    const HingeLimits right = constraintOf(doll, Role::rightLowerLeg).hinge;
    const auto changes = applyClipLimits(doll.profile, doll.rig, doll.character, ClipLimits::widen);
    REQUIRE(changes.size() == doll.profile.constraints.size());
    const HingeLimits after = constraintOf(doll, Role::leftLowerLeg).hinge;
    const float grown = (after.upper - after.lower) - (before.upper - before.lower);
    CHECK(grown > radians(35));
    CHECK(grown < radians(50));
    // The other knee does nothing in the clip and keeps its range.
    CHECK(constraintOf(doll, Role::rightLowerLeg).hinge.lower == right.lower);
    CHECK(constraintOf(doll, Role::rightLowerLeg).hinge.upper == right.upper);
    CHECK(validate(doll.profile).empty());
}

TEST_CASE("limits that hold the clips stay as they are when widened") {
    FittedDoll doll = dollThatTurns("leftLowerLeg", {1, 0, 0}, radians(60));
    const RagdollProfile before = doll.profile;
    applyClipLimits(doll.profile, doll.rig, doll.character, ClipLimits::widen);
    for (std::size_t i = 0; i < before.constraints.size(); ++i) {
        CHECK(doll.profile.constraints[i].hinge.lower == before.constraints[i].hinge.lower);
        CHECK(doll.profile.constraints[i].hinge.upper == before.constraints[i].hinge.upper);
        CHECK(doll.profile.constraints[i].cone.swingY == before.constraints[i].cone.swingY);
        CHECK(doll.profile.constraints[i].cone.swingZ == before.constraints[i].cone.swingZ);
        CHECK(doll.profile.constraints[i].cone.twist == before.constraints[i].cone.twist);
    }
}

TEST_CASE("fitted limits hold the clips and the bind pose and little else") {
    FittedDoll doll = dollThatTurns("leftUpperArm", {0, 0, 1}, -radians(70));
    const ConeTwistLimits before = constraintOf(doll, Role::leftUpperArm).cone;
    const auto changes = applyClipLimits(doll.profile, doll.rig, doll.character, ClipLimits::fit);
    for (const ClipLimitChange& change : changes) {
        if (change.kind == ConstraintProfile::Kind::hinge) {
            CHECK(change.hingeAfter.lower <= change.hingeUsed.lower);
            CHECK(change.hingeAfter.upper >= change.hingeUsed.upper);
        } else {
            CHECK(change.coneAfter.twist >= change.coneUsed.twist);
            CHECK(change.coneAfter.swingY >= change.coneUsed.swingY);
            CHECK(change.coneAfter.swingZ >= change.coneUsed.swingZ);
        }
    }
    // A head that never moves is left a tenth of its freedom or less.
    const ConeTwistLimits head = constraintOf(doll, Role::head).cone;
    CHECK(head.twist <= std::max(kLeastClipSpan, changes[0].coneUsed.twist) + 2 * kClipMargin);
    CHECK(constraintOf(doll, Role::leftUpperArm).cone.twist < before.twist + kClipMargin);
    CHECK(validate(doll.profile).empty());
}

TEST_CASE("a character without clips keeps its limits") {
    FittedDoll doll = dollThatTurns("head", {0, 1, 0}, 0.1F);
    doll.character.clips.clear();
    CHECK(applyClipLimits(doll.profile, doll.rig, doll.character, ClipLimits::fit).empty());
}
