#include "animation/retarget/anatomical_rig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace lutka::animation {
namespace {

constexpr float kNoLength = 1e-4F;  // metres

bool isOfArm(Role role) {
    return isEitherSide(role, Role::leftUpperArm) || isEitherSide(role, Role::leftLowerArm) ||
           isEitherSide(role, Role::leftHand);
}

Role onSide(Role left, Side side) {
    return side == Side::left ? left : mirrored(left);
}

// The way that a bone points in the bind pose; nothing when its end is not known or lies on its start.
std::optional<vec3> boneDirection(const AnatomicalRig& rig, Role from, Role to) {
    if (!rig.has(from) || !rig.has(to)) return std::nullopt;
    const vec3 way = rig.bindOf(to) - rig.bindOf(from);
    if (glm::length(way) < kNoLength) return std::nullopt;
    return glm::normalize(way);
}

// To where the fingers begin; nothing for a hand without joints below.
std::optional<vec3> handDirection(const AnatomicalRig& rig, int hand) {
    vec3 sum(0);
    for (int joint = hand + 1; joint < rig.skeleton->jointCount(); ++joint) {
        if (rig.skeleton->parents[joint] != hand) continue;
        sum += rig.standardBind[joint].translation - rig.standardBind[hand].translation;
    }
    if (glm::length(sum) < kNoLength) return std::nullopt;
    return glm::normalize(sum);
}

void setAxes(AnatomicalRig& rig, Role role, const quat& standardFromAnatomy) {
    if (!rig.has(role)) return;
    rig.jointFromAnatomy[indexOf(role)] =
        glm::conjugate(rig.standardBind[rig.jointOf(role)].rotation) * standardFromAnatomy;
}

// The axes of a limb's bones, each turned the shortest way from the one above it.
void setLimb(AnatomicalRig& rig, const std::array<Role, 4>& roles, const vec3& along, const vec3& aside) {
    vec3 direction = along;
    quat axes = rotationFromXY(along, aside);
    for (std::size_t i = 0; i + 1 < roles.size(); ++i) {
        auto next = boneDirection(rig, roles[i], roles[i + 1]);
        if (!next && isEitherSide(roles[i], Role::leftHand) && rig.has(roles[i]))
            next = handDirection(rig, rig.jointOf(roles[i]));
        if (next) {
            axes = rotationBetween(direction, *next) * axes;
            direction = *next;
        }
        setAxes(rig, roles[i], axes);
    }
}

// x to the left along hips and shoulders, y up the trunk.
quat trunkAxes(const AnatomicalRig& rig) {
    const vec3 hips = (rig.bindOf(Role::leftUpperLeg) + rig.bindOf(Role::rightUpperLeg)) * 0.5F;
    const vec3 up = rig.standardBind[rig.neckOrHead()].translation - hips;
    vec3 left = rig.bindOf(Role::leftUpperLeg) - rig.bindOf(Role::rightUpperLeg);
    if (rig.has(Role::leftUpperArm) && rig.has(Role::rightUpperArm))
        left += rig.bindOf(Role::leftUpperArm) - rig.bindOf(Role::rightUpperArm);
    if (glm::length(up) < kNoLength || glm::length(glm::cross(left, up)) < kNoLength * kNoLength) return {1, 0, 0, 0};
    const vec3 y = glm::normalize(up);
    return rotationFromXY(glm::normalize(left - y * glm::dot(left, y)), y);
}

// All joints from the hips to below the neck.
void setTrunk(AnatomicalRig& rig, const quat& axes) {
    const std::vector<int>& parents = rig.skeleton->parents;
    const int hips = rig.jointOf(Role::hips);
    std::vector<int> way;
    int at = parents[rig.neckOrHead()];
    for (; at != kNoJoint && at != hips; at = parents[at])
        way.push_back(at);
    std::reverse(way.begin(), way.end());
    if (at == kNoJoint) {
        // The hips lie beside the spine, which begins at its role; where the file has no spine in a row, the roles are
        // it.
        const auto spine = std::find(way.begin(), way.end(), rig.jointOf(Role::spine));
        const bool inRow = spine != way.end();
        way.erase(way.begin(), spine);
        for (const Role role : {Role::spine, Role::chest, Role::upperChest}) {
            if (!inRow && rig.has(role) && rig.jointOf(role) != hips) way.push_back(rig.jointOf(role));
        }
    }
    way.insert(way.begin(), hips);
    std::vector<float> lengths{0.0F};
    const auto add = [&](int from, int to) {
        const float step = glm::distance(rig.standardBind[from].translation, rig.standardBind[to].translation);
        lengths.push_back(lengths.back() + step);
    };
    for (std::size_t i = 1; i < way.size(); ++i)
        add(way[i - 1], way[i]);
    add(way.back(), rig.neckOrHead());
    const float whole = std::max(lengths.back(), kNoLength);
    for (std::size_t i = 0; i < way.size(); ++i)
        rig.trunk.push_back({way[i], lengths[i] / whole, glm::conjugate(rig.standardBind[way[i]].rotation) * axes});
}

void setFoot(AnatomicalRig& rig, Side side) {
    const Role foot = onSide(Role::leftFoot, side);
    const Role toes = onSide(Role::leftToes, side);
    AnatomicalRig::Foot& out = rig.feet[side == Side::left ? 0 : 1];
    out.joint = rig.jointOf(foot);
    vec3 ahead(0);
    if (rig.has(toes)) ahead = rig.bindOf(toes) - rig.bindOf(foot);
    // A foot without toes points to the ends that hang on it.
    for (int joint = out.joint + 1; !rig.has(toes) && joint < rig.skeleton->jointCount(); ++joint) {
        if (isAncestorOrSelf(*rig.skeleton, out.joint, joint))
            ahead += rig.standardBind[joint].translation - rig.bindOf(foot);
    }
    ahead.y = 0.0F;
    // Less than that says nothing of where the foot points.
    constexpr float kLeastAhead = 0.02F;
    if (glm::length(ahead) < kLeastAhead * rig.legLength || ahead.z < 0.0F) ahead = vec3(0, 0, 1);
    const quat axes = rotationFromXY(glm::normalize(ahead), vec3(0, 1, 0));
    setAxes(rig, foot, axes);
    setAxes(rig, toes, axes);
    out.upInJoint = glm::conjugate(rig.standardBind[out.joint].rotation) * vec3(0, 1, 0);
    out.ankleHeight = std::max(rig.bindOf(foot).y - rig.floor, 0.0F);
    // Where the toes would begin: a foot is about a quarter of a leg long, the ball at two thirds of that.
    constexpr float kBallAhead = 0.16F;
    vec3 ball = rig.bindOf(foot) + glm::normalize(ahead) * (kBallAhead * rig.legLength);
    ball.y = rig.floor;
    if (rig.has(toes)) ball = rig.bindOf(toes);
    out.ballInFoot = inverse(rig.standardBind[out.joint]) * ball;
    out.ballHeight = std::max(ball.y - rig.floor, 0.0F);
}

float legLengthOf(const AnatomicalRig& rig) {
    float sum = 0.0F;
    for (const Side side : {Side::left, Side::right}) {
        const vec3 hip = rig.bindOf(onSide(Role::leftUpperLeg, side));
        const vec3 knee = rig.bindOf(onSide(Role::leftLowerLeg, side));
        sum += glm::distance(hip, knee) + glm::distance(knee, rig.bindOf(onSide(Role::leftFoot, side)));
    }
    return sum * 0.5F;
}

void setFingers(AnatomicalRig& rig, Side side) {
    const Role role = onSide(Role::leftHand, side);
    if (!rig.has(role)) return;
    const int hand = rig.jointOf(role);
    const FingerChains chains = fingersOf(*rig.skeleton, hand);
    const quat handAxes = rig.standardBind[hand].rotation * rig.jointFromAnatomy[indexOf(role)];
    for (int finger = 0; finger < kFingerCount; ++finger) {
        quat axes = handAxes;
        for (std::size_t i = 0; i < chains[finger].size(); ++i) {
            const int joint = chains[finger][i];
            const vec3& from = rig.standardBind[joint].translation;
            if (i + 1 < chains[finger].size()) {
                const vec3 way = rig.standardBind[chains[finger][i + 1]].translation - from;
                if (glm::length(way) > kNoLength * 0.1F)
                    axes = rotationBetween(axes * vec3(1, 0, 0), glm::normalize(way)) * axes;
            }
            rig.fingers[side == Side::left ? 0 : 1][finger].push_back(
                {joint, glm::conjugate(rig.standardBind[joint].rotation) * axes});
        }
    }
}

void setAllAxes(AnatomicalRig& rig) {
    const quat trunk = trunkAxes(rig);
    for (const Role role :
         {Role::hips, Role::spine, Role::chest, Role::upperChest, Role::neck, Role::leftShoulder, Role::rightShoulder})
        setAxes(rig, role, trunk);
    setAxes(rig, Role::head, {1, 0, 0, 0});
    setTrunk(rig, trunk);
    for (const Side side : {Side::left, Side::right}) {
        const vec3 outwards(side == Side::left ? 1.0F : -1.0F, 0, 0);
        setLimb(rig,
                {onSide(Role::leftUpperArm, side), onSide(Role::leftLowerArm, side), onSide(Role::leftHand, side),
                 onSide(Role::leftHand, side)},
                outwards, vec3(0, 1, 0));
        setLimb(rig,
                {onSide(Role::leftUpperLeg, side), onSide(Role::leftLowerLeg, side), onSide(Role::leftFoot, side),
                 onSide(Role::leftToes, side)},
                vec3(0, -1, 0), vec3(0, 0, 1));
        setFoot(rig, side);
        setFingers(rig, side);
    }
}

}  // namespace

std::optional<Role> endOfBone(Role role) {
    constexpr std::array<std::array<Role, 2>, 5> kEnds{{{Role::leftUpperArm, Role::leftLowerArm},
                                                        {Role::leftLowerArm, Role::leftHand},
                                                        {Role::leftUpperLeg, Role::leftLowerLeg},
                                                        {Role::leftLowerLeg, Role::leftFoot},
                                                        {Role::leftFoot, Role::leftToes}}};
    for (const auto& [from, to] : kEnds) {
        if (isEitherSide(role, from)) return onSide(to, sideOf(role));
    }
    if (role == Role::neck) return Role::head;
    return std::nullopt;
}

float floorOf(const Character& character, const HumanoidMap& map) {
    const Skeleton& skeleton = character.skeleton;
    const auto heightOf = [&](int joint) {
        return (map.standardFromModel * skeleton.bindModelFromJoint[joint].translation).y;
    };
    const auto lowestOf = [&](Role left) {
        float lowest = std::numeric_limits<float>::max();
        for (const Role role : {left, mirrored(left)})
            if (map.jointOf(role) != kNoJoint) lowest = std::min(lowest, heightOf(map.jointOf(role)));
        return lowest;
    };
    float low = std::numeric_limits<float>::max();
    for (const SkinnedMesh& mesh : character.meshes)
        for (const vec3& position : mesh.positions)
            low = std::min(low, (map.standardFromModel * position).y);
    const bool hasSkin = low < std::numeric_limits<float>::max();
    const float ankles = lowestOf(Role::leftFoot);
    const float knees = lowestOf(Role::leftLowerLeg);
    const bool hasLegs = std::max(ankles, knees) < std::numeric_limits<float>::max();
    if (!hasLegs) return hasSkin ? low : 0.0F;
    // A cape or a stand below the soles is no floor, nor is skin that ends above them.
    if (low < ankles && ankles - low < 0.4F * (knees - ankles)) return low;
    low = ankles;
    for (const Role role : {Role::leftFoot, Role::rightFoot}) {
        const int foot = map.jointOf(role);
        for (int joint = std::max(foot, 0); foot != kNoJoint && joint < skeleton.jointCount(); ++joint)
            if (isAncestorOrSelf(skeleton, foot, joint)) low = std::min(low, heightOf(joint));
    }
    return low;
}

Result<AnatomicalRig> makeAnatomicalRig(const Character& character, const HumanoidMap& map) {
    const auto refuse = [&](std::string what, const char* mend) {
        return Error{ErrorCode::input, std::move(what), character.file.string(), mend};
    };
    if (!map.humanoid)
        return refuse(
            "is no humanoid",
            "map its joints, or take another model; of the scenes, those that walk and get up need a humanoid");
    LimbEnds ends = addLimbEnds(character, map);
    // A figure without an arm walks all the same.
    const auto needed = std::find_if_not(ends.missing.begin(), ends.missing.end(), isOfArm);
    if (needed != ends.missing.end()) {
        return refuse(fmt::format("lacks joints of a whole humanoid, the first is {}", roleName(*needed)),
                      "name a joint for it, if there is one: --map");
    }
    AnatomicalRig rig;
    rig.skeleton = std::move(ends.skeleton);
    rig.fileJoints = character.skeleton.jointCount();
    rig.stiffLimbs = std::move(ends.stiff);
    rig.standardFromModel = map.standardFromModel;
    rig.joint = ends.joint;
    for (const RigidTransform& bind : rig.skeleton->bindModelFromJoint)
        rig.standardBind.push_back({rig.standardFromModel * bind.rotation, rig.standardFromModel * bind.translation});
    rig.floor = ends.ankleHeight ? rig.bindOf(Role::leftFoot).y - *ends.ankleHeight : floorOf(character, map);
    rig.legLength = legLengthOf(rig);
    if (!(rig.legLength > kNoLength)) return refuse("has legs without length", "check its bind pose");
    setAllAxes(rig);
    return rig;
}

}  // namespace lutka::animation
