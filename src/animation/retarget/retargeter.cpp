#include "animation/retarget/retargeter.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "animation/ik/two_bone.hpp"
#include "animation/pose.hpp"
#include "animation/retarget/foot_keeper.hpp"
#include "core/assert.hpp"

namespace lutka::animation {
namespace {

// Bones whose joints in between share their twist.
constexpr std::array kBones{
    std::array{Role::leftUpperArm, Role::leftLowerArm}, std::array{Role::leftLowerArm, Role::leftHand},
    std::array{Role::leftUpperLeg, Role::leftLowerLeg}, std::array{Role::leftLowerLeg, Role::leftFoot},
    std::array{Role::leftFoot, Role::leftToes},         std::array{Role::rightUpperArm, Role::rightLowerArm},
    std::array{Role::rightLowerArm, Role::rightHand},   std::array{Role::rightUpperLeg, Role::rightLowerLeg},
    std::array{Role::rightLowerLeg, Role::rightFoot},   std::array{Role::rightFoot, Role::rightToes}};

// How far a knee must stand out, in leg lengths, for its own way to outweigh straight ahead.
constexpr float kAheadShare = 0.08F;
// The most that a trunk is leant further than its joints' turns make it.
constexpr float kMostLean = radians(40.0F);

quat mixed(const quat& a, const quat& b, float share) {
    return interpolate({a, vec3(0)}, {b, vec3(0)}, share).rotation;
}

// The part of a rotation about a unit axis, `share` of its angle.
quat twistShare(const quat& rotation, const vec3& axis, float share) {
    const float along = glm::dot(vec3(rotation.x, rotation.y, rotation.z), axis);
    const float angle = 2.0F * std::atan2(along, rotation.w);
    const float shortest = angle > kPi ? angle - 2.0F * kPi : angle < -kPi ? angle + 2.0F * kPi : angle;
    return glm::angleAxis(shortest * share, axis);
}

// Of the lower foot's sole over the floor.
float heightOfFeet(const AnatomicalRig& rig, std::span<const RigidTransform> pose, float floor) {
    float least = std::numeric_limits<float>::max();
    for (const AnatomicalRig::Foot& foot : rig.feet) {
        const vec3 up = pose[foot.joint].rotation * foot.upInJoint;
        least = std::min(least, -depthOf(foot, pose[foot.joint].translation, foot.ballIn(pose), up, floor));
    }
    return least;
}

TwoBone legBones() {
    TwoBone bones;
    bones.mostFlexion = radians(170.0F);
    return bones;
}

}  // namespace

Result<Retargeter> Retargeter::make(const Character& source, const HumanoidMap& sourceMap, const Character& target,
                                    const HumanoidMap& targetMap) {
    auto from = makeAnatomicalRig(source, sourceMap);
    if (!from) return from.error();
    auto to = makeAnatomicalRig(target, targetMap);
    if (!to) return to.error();
    return Retargeter(std::move(from).value(), std::move(to).value(), target);
}

Retargeter::Retargeter(AnatomicalRig source, AnatomicalRig target, const Character& character)
    : source_(std::move(source)),
      target_(std::move(target)),
      isDriven_(target_.standardBind.size(), false),
      sourceLocal_(source_.skeleton->nodeParentFromJoint),
      sourceStandard_(source_.standardBind.size()),
      targetStandard_(target_.standardBind.size()),
      targetBindLocal_(target_.standardBind.size()) {
    modelToLocal(*target_.skeleton, target_.standardBind, targetBindLocal_);
    const vec3 middle = (target_.bindOf(Role::leftUpperLeg) + target_.bindOf(Role::rightUpperLeg)) * 0.5F;
    hipsFromMiddle_ = target_.bindOf(Role::hips) - middle;
    planTrunk();
    planLimbs();
    planFingers();
    planCarried(character);
}

// The joint itself or the nearest above it that is driven.
int Retargeter::drivenAbove(int joint) const {
    while (joint != kNoJoint && !isDriven_[joint])
        joint = target_.skeleton->parents[joint];
    return joint;
}

// Which driven joint takes one along that hangs on none: the hips what lies above them, else the nearest.
int Retargeter::carrierOf(int joint) const {
    const int hips = target_.jointOf(Role::hips);
    if (isAncestorOrSelf(*target_.skeleton, joint, hips)) return hips;
    int nearest = hips;
    float least = std::numeric_limits<float>::max();
    for (int other = 0; other < target_.skeleton->jointCount(); ++other) {
        const int driven = drivenAbove(other);
        if (driven == kNoJoint) continue;
        const float distance =
            glm::distance(target_.standardBind[other].translation, target_.standardBind[joint].translation);
        if (distance >= least) continue;
        least = distance;
        nearest = driven;
    }
    return nearest;
}

void Retargeter::planCarried(const Character& character) {
    std::vector<bool> movesSkin(target_.standardBind.size(), false);
    for (const SkinnedMesh& mesh : character.meshes)
        for (std::size_t vertex = 0; vertex < mesh.joints.size(); ++vertex)
            for (std::size_t i = 0; i < mesh.joints[vertex].size(); ++i)
                if (mesh.weights[vertex][i] > 0.0F) movesSkin[mesh.joints[vertex][i]] = true;
    std::vector<Driven> carried;
    for (int joint = 0; joint < target_.skeleton->jointCount(); ++joint) {
        if (!movesSkin[joint] || drivenAbove(joint) != kNoJoint) continue;
        const int base = carrierOf(joint);
        carried.push_back({.by = Driven::By::carried,
                           .joint = joint,
                           .base = base,
                           .baseFromJoint = inverse(target_.standardBind[base]) * target_.standardBind[joint]});
    }
    // Not before all have been told: none carries another.
    for (const Driven& driven : carried) {
        isDriven_[driven.joint] = true;
        driven_.push_back(driven);
    }
}

// A joint of the target, with those on its way up to the nearest that is driven; `otherwiseBelow` is what it hangs on
// when the file has it on nothing that is (a foot below an IK root).
Retargeter::Driven& Retargeter::plan(int joint, int otherwiseBelow) {
    const std::vector<int>& parents = target_.skeleton->parents;
    std::vector<int> way{joint};
    int at = parents[joint];
    for (; at != kNoJoint && !isDriven_[at]; at = parents[at])
        way.push_back(at);
    if (at == kNoJoint) way.resize(1);
    int base = at == kNoJoint ? otherwiseBelow : at;
    for (auto next = way.rbegin(); next != way.rend(); ++next) {
        Driven driven;
        driven.joint = *next;
        driven.base = base;
        driven.baseFromJoint = base == kNoJoint ? target_.standardBind[*next]
                                                : inverse(target_.standardBind[base]) * target_.standardBind[*next];
        driven_.push_back(driven);
        isDriven_[*next] = true;
        base = *next;
    }
    return driven_.back();
}

void Retargeter::planTrunk() {
    const std::vector<AnatomicalRig::TrunkJoint>& from = source_.trunk;
    for (const AnatomicalRig::TrunkJoint& joint : target_.trunk) {
        Driven& driven = plan(joint.joint, driven_.empty() ? kNoJoint : driven_.back().joint);
        driven.by = driven_.size() == 1 ? Driven::By::hips : Driven::By::trunk;
        driven.jointFromAnatomy = joint.jointFromAnatomy;
        // Less and less of it up to the neck; a joint that carries the legs goes with the hips.
        const bool carriesLegs = isAncestorOrSelf(*target_.skeleton, joint.joint, target_.jointOf(Role::leftUpperLeg));
        driven.hipsTurn = carriesLegs ? 1.0F : 1.0F - joint.at;
        const auto above =
            std::find_if(from.begin(), from.end(), [&](const auto& other) { return other.at > joint.at; });
        driven.trunk = static_cast<std::size_t>(above - from.begin()) - 1;
        if (above != from.end()) driven.share = (joint.at - (above - 1)->at) / (above->at - (above - 1)->at);
    }
    // The hips are the hips, whatever lies at their place.
    driven_.front().trunk = 0;
    driven_.front().share = 0.0F;
}

// The joint of `to` with those between it and `from`'s, which share the bone's twist.
void Retargeter::planBone(Role from, Role to) {
    if (!target_.has(to)) return;
    const std::size_t first = driven_.size();
    Driven& end = plan(target_.jointOf(to), target_.has(from) ? target_.jointOf(from) : target_.trunk.back().joint);
    end.role = to;
    end.jointFromAnatomy = target_.jointFromAnatomy[indexOf(to)];
    // A role that the source doesn't have stays as it is on its base.
    end.by = source_.has(to) ? Driven::By::role : Driven::By::carried;
    if (!source_.has(to) || !source_.has(from)) return;
    float length = 0.0F;
    for (std::size_t i = first; i < driven_.size(); ++i)
        length += glm::length(driven_[i].baseFromJoint.translation);
    float way = 0.0F;
    for (std::size_t i = first; i + 1 < driven_.size(); ++i) {
        way += glm::length(driven_[i].baseFromJoint.translation);
        driven_[i].by = Driven::By::twist;
        driven_[i].role = from;
        driven_[i].share = way / std::max(length, 1e-6F);
    }
}

void Retargeter::planLimbs() {
    const int hips = target_.jointOf(Role::hips);
    const int top = target_.trunk.back().joint;
    const auto add = [&](Role role, int below) {
        if (!target_.has(role) || isDriven_[target_.jointOf(role)]) return;
        Driven& driven = plan(target_.jointOf(role), below);
        driven.role = role;
        driven.jointFromAnatomy = target_.jointFromAnatomy[indexOf(role)];
        driven.by = source_.has(role) ? Driven::By::role : Driven::By::carried;
    };
    add(Role::neck, top);
    add(Role::head, target_.has(Role::neck) ? target_.jointOf(Role::neck) : top);
    for (const Role left : {Role::leftShoulder, Role::leftUpperArm, Role::leftUpperLeg}) {
        add(left, left == Role::leftUpperLeg ? hips : top);
        add(mirrored(left), left == Role::leftUpperLeg ? hips : top);
    }
    for (const auto& [from, to] : kBones)
        planBone(from, to);
}

void Retargeter::planFingers() {
    for (std::size_t side = 0; side < 2; ++side) {
        const Role hand = side == 0 ? Role::leftHand : Role::rightHand;
        for (std::size_t finger = 0; finger < static_cast<std::size_t>(kFingerCount); ++finger) {
            const auto& from = source_.fingers[side][finger];
            const auto& to = target_.fingers[side][finger];
            for (std::size_t i = 0; i < std::min(from.size(), to.size()); ++i) {
                Driven& driven = plan(to[i].joint, target_.jointOf(hand));
                driven.by = Driven::By::finger;
                driven.jointFromAnatomy = to[i].jointFromAnatomy;
                driven.sourceJoint = from[i].joint;
                driven.sourceFromAnatomy = from[i].jointFromAnatomy;
            }
        }
    }
}

// A role's anatomical axes in the source's pose, standard space.
quat Retargeter::sourceAxes(Role role) const {
    return sourceStandard_[source_.jointOf(role)].rotation * source_.jointFromAnatomy[indexOf(role)];
}

// What a joint within a bone adds to its base: its share of how the bone's end is twisted against the bone. Both turns
// are taken from the target's bind pose, about the bone as it lies there.
quat Retargeter::twistOf(const Driven& driven) const {
    const Role end = *endOfBone(driven.role);
    const auto turned = [&](Role role) {
        const quat bindAxes =
            target_.standardBind[target_.jointOf(role)].rotation * target_.jointFromAnatomy[indexOf(role)];
        return sourceAxes(role) * glm::conjugate(bindAxes);
    };
    const quat bone = turned(driven.role);
    const vec3 axis = glm::normalize(target_.bindOf(end) - target_.bindOf(driven.role));
    const quat twist = twistShare(glm::conjugate(bone) * turned(end), axis, driven.share);
    return bone * twist * target_.standardBind[driven.joint].rotation;
}

quat Retargeter::rotationOf(const Driven& driven) const {
    switch (driven.by) {
        case Driven::By::hips:
        case Driven::By::trunk: {
            const auto axes = [&](std::size_t at) {
                const AnatomicalRig::TrunkJoint& joint = source_.trunk[at];
                return sourceStandard_[joint.joint].rotation * joint.jointFromAnatomy;
            };
            const quat below = axes(driven.trunk);
            const quat here = driven.share > 0.0F ? mixed(below, axes(driven.trunk + 1), driven.share) : below;
            return here * glm::conjugate(driven.jointFromAnatomy);
        }
        case Driven::By::role:
            return sourceAxes(driven.role) * glm::conjugate(driven.jointFromAnatomy);
        case Driven::By::twist:
            return twistOf(driven);
        case Driven::By::finger:
            return sourceStandard_[driven.sourceJoint].rotation * driven.sourceFromAnatomy *
                   glm::conjugate(driven.jointFromAnatomy);
        case Driven::By::carried:
            break;
    }
    return targetStandard_[driven.base].rotation * driven.baseFromJoint.rotation;
}

void Retargeter::turnJoints(const vec3& hipsTurn) {
    const float angle = glm::length(hipsTurn);
    for (const Driven& driven : driven_) {
        quat& rotation = targetStandard_[driven.joint].rotation;
        rotation = glm::normalize(rotationOf(driven));
        if (angle < 1e-6F || (driven.by != Driven::By::hips && driven.by != Driven::By::trunk)) continue;
        rotation = glm::normalize(glm::angleAxis(angle * driven.hipsTurn, hipsTurn / angle) * rotation);
    }
}

// Down from the hips, with the rotations that are there.
void Retargeter::placeJoints(const RetargetPlacement& placement, const vec3& hipsShift) {
    const vec3 middle = (sourceStandard_[source_.jointOf(Role::leftUpperLeg)].translation +
                         sourceStandard_[source_.jointOf(Role::rightUpperLeg)].translation) *
                        0.5F;
    // Told from the ankles' height: soles of any thickness leave the knees as bent as the source's.
    const vec3 sourceAnkles(0, placement.sourceFloor + source_.ankleHeight(), 0);
    vec3 hips = (middle - sourceAnkles) * scale() + vec3(0, target_.floor + target_.ankleHeight(), 0);
    const int joint = target_.jointOf(Role::hips);
    const quat turned = targetStandard_[joint].rotation * glm::conjugate(target_.standardBind[joint].rotation);
    hips += turned * hipsFromMiddle_ + hipsShift;
    for (const Driven& driven : driven_) {
        RigidTransform& out = targetStandard_[driven.joint];
        out.translation =
            driven.by == Driven::By::hips ? hips : targetStandard_[driven.base] * driven.baseFromJoint.translation;
    }
}

// Trunks are cut into segments at other heights, so that the same turns lean them otherwise. All above the hips is
// leant by what is missing from between the hip joints to the neck.
void Retargeter::leanTrunk() {
    if (target_.trunk.size() < 2) return;
    const auto middleOf = [](const AnatomicalRig& rig, std::span<const RigidTransform> pose) {
        const vec3& left = pose[rig.jointOf(Role::leftUpperLeg)].translation;
        return (left + pose[rig.jointOf(Role::rightUpperLeg)].translation) * 0.5F;
    };
    const vec3 way = sourceStandard_[source_.neckOrHead()].translation - middleOf(source_, sourceStandard_);
    const vec3 middle = middleOf(target_, targetStandard_);
    const vec3 start = targetStandard_[target_.trunk[1].joint].translation - middle;
    const vec3 arm = targetStandard_[target_.neckOrHead()].translation - middle - start;
    if (glm::length(way) < 1e-6F || glm::length(arm) < 1e-6F) return;
    // Where the neck's sphere about the trunk's second joint meets the source's direction, the further of the two.
    const vec3 direction = glm::normalize(way);
    const float along = glm::dot(direction, start);
    const float root = along * along - glm::dot(start, start) + glm::dot(arm, arm);
    const vec3 wanted = direction * (along + std::sqrt(std::max(root, 0.0F))) - start;
    const vec3 turn = rotationVector(rotationBetween(arm, wanted));
    const float angle = glm::length(turn);
    if (angle < 1e-6F) return;
    const quat lean = glm::angleAxis(std::min(angle, kMostLean), turn / angle);
    for (std::size_t i = 1; i < target_.trunk.size(); ++i) {
        quat& rotation = targetStandard_[target_.trunk[i].joint].rotation;
        rotation = glm::normalize(lean * rotation);
    }
    // Shoulders that follow nothing of the source's.
    for (const Driven& driven : driven_) {
        if (driven.by == Driven::By::carried)
            targetStandard_[driven.joint].rotation = glm::normalize(rotationOf(driven));
    }
}

// Moves an ankle: the leg's bones turn, the foot keeps its own rotation.
void Retargeter::bendLeg(int side, const vec3& shift) {
    if (shift == vec3(0)) return;
    const auto of = [&](Role left) { return target_.jointOf(side == 0 ? left : mirrored(left)); };
    const int upper = of(Role::leftUpperLeg);
    const int lower = of(Role::leftLowerLeg);
    const int foot = of(Role::leftFoot);
    TwoBoneGoal goal;
    goal.target = targetStandard_[foot].translation + shift;
    goal.softness = 0.0005F;  // the hips have come down by what is missing
    const BonePoints points{targetStandard_[upper].translation, targetStandard_[lower].translation,
                            targetStandard_[foot].translation};
    // The knee's own way, and ahead where it is straight or past it: knees don't bend backwards.
    const Role thigh = side == 0 ? Role::leftUpperLeg : Role::rightUpperLeg;
    const vec3 ahead = targetStandard_[upper].rotation * (target_.jointFromAnatomy[indexOf(thigh)] * vec3(0, 1, 0));
    const vec3 chord = points.end - points.start;
    const vec3 knee = points.middle - points.start;
    const vec3 own = knee - chord * (glm::dot(knee, chord) / std::max(glm::dot(chord, chord), 1e-12F));
    goal.pole = own + ahead * (kAheadShare * target_.legLength);
    const BoneTurns turns = turnsToReach(points, legBones(), ahead, goal);
    for (const Driven& driven : driven_) {
        if (!isAncestorOrSelf(*target_.skeleton, upper, driven.joint)) continue;
        if (isAncestorOrSelf(*target_.skeleton, foot, driven.joint)) continue;
        const bool below = isAncestorOrSelf(*target_.skeleton, lower, driven.joint);
        quat& rotation = targetStandard_[driven.joint].rotation;
        rotation = glm::normalize((below ? turns.lower : turns.upper) * rotation);
    }
}

// A limb without a joint in its middle points to where the bent one would end. Legs are longer by that: the lower foot
// is put as high over the floor as the source's.
void Retargeter::straightenLimbs(const RetargetPlacement& placement) {
    const std::vector<RigidTransform>& bind = target_.standardBind;
    for (const StiffLimb& limb : target_.stiffLimbs) {
        RigidTransform& upper = targetStandard_[limb.upper];
        RigidTransform& middle = targetStandard_[limb.middle];
        RigidTransform& end = targetStandard_[limb.end];
        const RigidTransform upperFromEnd = inverse(bind[limb.upper]) * bind[limb.end];
        const vec3 bent = middle * (inverse(bind[limb.middle]) * bind[limb.end]).translation - upper.translation;
        const vec3 straight = upper.rotation * upperFromEnd.translation;
        quat turn(1, 0, 0, 0);
        if (glm::length(bent) > 1e-6F && glm::length(straight) > 1e-6F) turn = rotationBetween(straight, bent);
        upper.rotation = glm::normalize(turn * upper.rotation);
        const vec3 endMoved = upper * upperFromEnd.translation - end.translation;
        for (const Driven& driven : driven_) {
            RigidTransform& joint = targetStandard_[driven.joint];
            // A hand or foot of the file's own keeps its way, with all that is on it.
            if (isAncestorOrSelf(*target_.skeleton, limb.end, driven.joint)) {
                joint.translation += endMoved;
            } else if (driven.joint != limb.upper && isAncestorOrSelf(*target_.skeleton, limb.upper, driven.joint)) {
                joint.rotation = glm::normalize(turn * joint.rotation);
                joint.translation = upper.translation + turn * (joint.translation - upper.translation);
            }
        }
        middle = upper * (inverse(bind[limb.upper]) * bind[limb.middle]);
        if (limb.end >= target_.fileJoints) end.rotation = glm::normalize(upper.rotation * upperFromEnd.rotation);
    }
    if (!target_.hasStiffLegs()) return;
    const float lift = scale() * heightOfFeet(source_, sourceStandard_, placement.sourceFloor) -
                       heightOfFeet(target_, targetStandard_, target_.floor);
    for (const Driven& driven : driven_)
        targetStandard_[driven.joint].translation.y += lift;
}

void Retargeter::writeLocals(std::span<RigidTransform> targetParentFromJoint) const {
    const RigidTransform modelFromStandard{glm::conjugate(target_.standardFromModel), vec3(0)};
    const std::vector<int>& parents = target_.skeleton->parents;
    for (std::size_t joint = 0; joint < targetParentFromJoint.size(); ++joint) {
        const int parent = parents[joint];
        targetParentFromJoint[joint] = parent == kNoJoint ? modelFromStandard * targetStandard_[joint]
                                                          : inverse(targetStandard_[parent]) * targetStandard_[joint];
        targetParentFromJoint[joint].rotation = glm::normalize(targetParentFromJoint[joint].rotation);
    }
}

void Retargeter::pose(std::span<const RigidTransform> sourceParentFromJoint, const RetargetPlacement& placement,
                      std::span<RigidTransform> targetParentFromJoint) {
    pose(sourceParentFromJoint, placement, {}, targetParentFromJoint);
}

void Retargeter::pose(std::span<const RigidTransform> sourceParentFromJoint, const RetargetPlacement& placement,
                      const FootShift& shift, std::span<RigidTransform> targetParentFromJoint) {
    LUTKA_ASSERT(sourceParentFromJoint.size() == static_cast<std::size_t>(source_.fileJoints));
    LUTKA_ASSERT(targetParentFromJoint.size() == static_cast<std::size_t>(target_.fileJoints));
    std::copy(sourceParentFromJoint.begin(), sourceParentFromJoint.end(), sourceLocal_.begin());
    localToModel(*source_.skeleton, sourceLocal_, sourceStandard_);
    const RigidTransform standardFromModel{source_.standardFromModel, vec3(0)};
    for (RigidTransform& frame : sourceStandard_)
        frame = standardFromModel * frame;
    turnJoints(shift.hipsTurn);
    placeJoints(placement, shift.hips);
    leanTrunk();
    bendLeg(0, shift.feet[0]);
    bendLeg(1, shift.feet[1]);
    for (const Driven& driven : driven_)
        if (driven.by == Driven::By::carried)
            targetStandard_[driven.joint].rotation = glm::normalize(rotationOf(driven));
    placeJoints(placement, shift.hips);
    if (!target_.stiffLimbs.empty()) straightenLimbs(placement);
    // What follows nothing keeps its place under its parent.
    const std::vector<int>& parents = target_.skeleton->parents;
    for (std::size_t joint = 0; joint < targetStandard_.size(); ++joint) {
        if (isDriven_[joint]) continue;
        const int parent = parents[joint];
        targetStandard_[joint] =
            parent == kNoJoint ? target_.standardBind[joint] : targetStandard_[parent] * targetBindLocal_[joint];
    }
    writeLocals(targetParentFromJoint);
}

}  // namespace lutka::animation
