#include "animation/humanoid/map_humanoid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "animation/humanoid/completed_rig.hpp"
#include "animation/humanoid/crowds.hpp"
#include "animation/humanoid/figure.hpp"
#include "animation/humanoid/imagined_limbs.hpp"
#include "animation/humanoid/rig_features.hpp"
#include "animation/humanoid/role_assembly.hpp"
#include "core/assert.hpp"

namespace lutka::animation {
namespace {

constexpr float kFixed = 40.0F;  // log-odds of what the user or the file says
constexpr int kFewestJoints = 5;
constexpr float kLoudShape = 1.5F;           // log-odds of the facing by shape that are worth a word against the names
constexpr float kImagined = 4.0F;            // log-odds against a limb that is not there
constexpr float kLeastShapeOfImages = 3.0F;  // of Figure::shapeScore(), where nothing else makes a figure
constexpr float kLeastShapeUnnamed = 6.0F;   // … nor names speak for one
constexpr float kLeastShapeOfImagined = 0.0F;  // … and names tell it, of which both arms or both legs are missing
constexpr int kMostMissing = 7;                // of the 15 required roles, without a warning

using FixedJoints = std::array<std::optional<int>, kRoleCount>;

HumanoidMap refused(std::string reason) {
    HumanoidMap map;
    map.warnings.push_back("not a humanoid: " + std::move(reason));
    return map;
}

// Hands and feet by their names that hang on the trunk: figures whose arms and legs are not there at all.
bool floatsHandsAndFeet(const RigFeatures& rig) {
    const auto isThere = [&](Part part, Side side) {
        const int joint = rig.namedJoint(part, side, kTellsPartOfLimb);
        return joint != kNoJoint && rig.carriesSkin(joint);
    };
    for (const Side side : {Side::left, Side::right}) {
        if (!isThere(Part::hand, side) || !isThere(Part::foot, side)) return false;
        for (const Part part : {Part::upperArm, Part::lowerArm, Part::upperLeg, Part::lowerLeg})
            if (isThere(part, side)) return false;
    }
    return true;
}

// A fixed binding speaks as the loudest name: the search is drawn to it and keeps the rest consistent.
void teachFixed(const FixedJoints& fixed, RigFeatures& rig) {
    for (int index = 0; index < kRoleCount; ++index) {
        if (!fixed[index]) continue;
        NameEvidence& name = rig.names[*fixed[index]];
        name.parts.values.fill(-kFixed);
        name.parts[partOf(roleAt(index))] = kFixed;
        name.side = sideOf(roleAt(index));
        name.helper = name.creature = false;
        name.meaningful = true;
    }
}

void bindFixed(const FixedJoints& fixed, std::string_view reason, HumanoidMap& map) {
    for (int index = 0; index < kRoleCount; ++index) {
        if (!fixed[index]) continue;
        for (auto& binding : map.roles) {
            if (binding && binding->joint == *fixed[index]) binding.reset();
        }
    }
    for (int index = 0; index < kRoleCount; ++index) {
        if (fixed[index]) map.roles[index] = RoleBinding{*fixed[index], 1.0F, std::string(reason)};
    }
}

// The nearest role above that has a joint.
std::optional<Role> boundAbove(const HumanoidMap& map, Role role) {
    std::optional<Role> above = parentRole(role);
    while (above && !map[*above])
        above = parentRole(*above);
    return above;
}

// What the user fixed is kept, but not believed where a limb would hang on what it carries: a thigh at the joint of the
// foot. Feet beside their legs are how some rigs drive them, and other limbs are the doctor's affair.
void questionFixed(const FixedJoints& fixed, const Skeleton& skeleton, HumanoidMap& map) {
    constexpr float kReversed = 0.1F;
    for (int index = 0; index < kRoleCount; ++index) {
        const Role role = roleAt(index);
        const std::optional<Role> above = map.roles[index] ? boundAbove(map, role) : std::nullopt;
        if (!above || (!fixed[index] && !fixed[indexOf(*above)])) continue;
        const int joint = map.jointOf(role);
        const int parent = map.jointOf(*above);
        if (joint == parent || !isAncestorOrSelf(skeleton, joint, parent)) continue;
        const std::string text =
            fmt::format("{} at \"{}\" lies above {} at \"{}\", which it should hang on", roleName(role),
                        skeleton.names[joint], roleName(*above), skeleton.names[parent]);
        for (const Role one : {role, *above}) {
            if (!fixed[indexOf(one)]) continue;
            map.roles[indexOf(one)]->confidence = kReversed;
            map.roles[indexOf(one)]->reason = "fixed by the user, but " + text;
        }
        map.confidence = std::min(map.confidence, kReversed);
        map.warnings.push_back("is this right? " + text);
    }
}

FixedJoints jointsOfFile(const Character& character) {
    FixedJoints joints;
    for (const auto& [name, joint] : character.vrmHumanoid) {
        const auto role = roleFromName(name);
        if (role && joint >= 0 && joint < character.skeleton.jointCount()) joints[indexOf(*role)] = joint;
    }
    return joints;
}

// Up and facing of a figure whose bindings, sides included, are taken as true; nothing when too few are bound.
std::optional<quat> stanceOfBindings(const FixedJoints& joints, const Skeleton& skeleton) {
    const auto at = [&](Role role) { return skeleton.bindModelFromJoint[*joints[indexOf(role)]].translation; };
    for (const Role role :
         {Role::hips, Role::leftUpperArm, Role::rightUpperArm, Role::leftUpperLeg, Role::rightUpperLeg}) {
        if (!joints[indexOf(role)]) return std::nullopt;
    }
    const vec3 arms = at(Role::leftUpperArm) + at(Role::rightUpperArm);
    const vec3 legs = at(Role::leftUpperLeg) + at(Role::rightUpperLeg);
    const vec3 rise = arms - legs;
    vec3 up(0);
    const int axis = std::abs(rise.y) >= std::max(std::abs(rise.x), std::abs(rise.z)) ? 1
                     : std::abs(rise.x) > std::abs(rise.z)                            ? 0
                                                                                      : 2;
    up[axis] = rise[axis] < 0.0F ? -1.0F : 1.0F;
    vec3 left = at(Role::leftUpperArm) - at(Role::rightUpperArm) + at(Role::leftUpperLeg) - at(Role::rightUpperLeg);
    left -= glm::dot(left, up) * up;
    if (glm::length(left) <= 0.0F || glm::length(rise) <= 0.0F) return std::nullopt;
    return glm::conjugate(rotationFromXY(glm::normalize(left), up));
}

void addWarnings(const Figure& figure, HumanoidMap& map) {
    const RigFeatures& rig = *figure.framed.rig;
    if (rig.partlySkinned) {
        map.warnings.emplace_back("only a part of the figure has skin: the other shapes come from the joints alone");
    } else if (!rig.skinned) {
        map.warnings.emplace_back(rig.vertices.empty() ? "the skeleton has no skin: shapes come from the joints alone"
                                                       : "the figure has no skin, only rigid parts");
    }
    if (figure.facing.namesSplit) {
        map.warnings.push_back(
            fmt::format("the names call the arm of the one half left and the leg of the other: some of them are wrong, "
                        "so look which way it faces ({})",
                        figure.facing.reason));
    } else if (figure.facing.namesDisagree()) {
        map.warnings.push_back(
            fmt::format("left and right in the names disagree with the geometry, which is followed ({})",
                        figure.facing.shapeReason));
    } else if (figure.facing.shape * figure.facing.names < -kLoudShape * std::abs(figure.facing.names)) {
        map.warnings.push_back(
            fmt::format("the geometry speaks against left and right in the names, which are followed ({})",
                        figure.facing.shapeReason));
    } else if (std::abs(figure.facing.total()) < 1.0F) {
        map.warnings.emplace_back("front and back look alike: left and right may be exchanged");
    }
}

// The figure, and the rig that it refers to where that is not the character's own.
struct Reading {
    std::vector<CompletedRig> completed;
    bool ofImages = false;
    Figure figure;
};

// No limb may pair an image with anything but its original: a head with the image of an arm. What lies in the middle
// has no image: arms that are crossed before the chest and hang on one joint.
bool isHonest(const CompletedRig& completed, const Figure& figure) {
    constexpr float kBeside = 0.04F;  // of the spread
    const auto isImage = [&](int joint) { return completed.isImage(joint); };
    for (const LimbCandidate* limb : {&figure.arms, &figure.legs}) {
        for (const int pair : limb->pairs) {
            if (pair == kNoPair) continue;
            const auto& joints = figure.framed.pairs[pair].joints;
            if (!completed.isHonestPair(joints[0], joints[1])) return false;
        }
        const JointPair& first = figure.framed.pairs[limb->first];
        const bool imaged = std::any_of(first.joints.begin(), first.joints.end(), isImage);
        if (imaged && std::abs(first.position.x) < kBeside * figure.framed.spread) return false;
    }
    return true;
}

float leastShapeOf(const CompletedRig& completed, const Figure& figure) {
    if (completed.imagined) return kLeastShapeOfImagined;
    // A root and a neck, or what sounds like them, have rooms and machines as well.
    const bool named = figure.legs.names + figure.arms.names > 0.0F;
    return named ? kLeastShapeOfImages : kLeastShapeUnnamed;
}

// A missing arm or leg is replaced by the mirror image of the other, and a missing pair by limbs of a human's
// proportions. Where names tell all limbs, none is missing, however a pose bends them.
Reading readFigure(const RigFeatures& rig) {
    Reading reading;
    reading.figure = findFigure(rig);
    if (reading.figure.refusal.empty() && reading.figure.legs.told && reading.figure.arms.told) return reading;
    reading.completed = completeRig(rig);
    // Collars and bosoms make arms only where nothing says what they are.
    const bool contradicted = reading.figure.arms.names < 0.0F || reading.figure.legs.names < 0.0F;
    if (!reading.figure.refusal.empty() || contradicted) {
        for (CompletedRig& imagined : imagineLimbs(rig))
            reading.completed.push_back(std::move(imagined));
    }
    for (const CompletedRig& completed : reading.completed) {
        Figure figure = findFigure(completed.rig);
        if (!figure.refusal.empty() || !isHonest(completed, figure)) continue;
        // Animals lie: what has to be turned has limbs of its own.
        if (figure.prior < 0.0F && !reading.figure.refusal.empty()) continue;
        const bool stands = reading.figure.refusal.empty() && !completed.imagined;
        if (stands ? figure.score < reading.figure.score + kImagined
                   : figure.shapeScore() < leastShapeOf(completed, figure))
            continue;
        reading.ofImages = true;
        reading.figure = std::move(figure);
    }
    return reading;
}

void tellMissingLimbs(HumanoidMap& map) {
    constexpr float kIncomplete = 0.9F;
    for (const auto& [upper, limb] :
         {std::pair{Role::leftUpperArm, "left arm"}, std::pair{Role::rightUpperArm, "right arm"},
          std::pair{Role::leftUpperLeg, "left leg"}, std::pair{Role::rightUpperLeg, "right leg"}}) {
        if (map[upper]) continue;
        map.confidence *= kIncomplete;
        map.warnings.push_back(fmt::format("the figure has no joints of a {}", limb));
    }
}

// Joints that the user or the file names stay, whatever stands beside them.
std::vector<int> namedJoints(const Character& character, const MapOptions& options) {
    std::vector<int> joints;
    for (const auto& joint : options.fixed) {
        if (joint) joints.push_back(*joint);
    }
    for (const auto& joint : jointsOfFile(character)) {
        if (joint) joints.push_back(*joint);
    }
    return joints;
}

void listMissing(HumanoidMap& map) {
    map.missing.clear();
    for (int index = 0; index < kRoleCount; ++index) {
        if (isRequired(roleAt(index)) && !map.roles[index]) map.missing.push_back(roleAt(index));
    }
}

// Of a character without crowds.
HumanoidMap mapWhole(const Character& character, const MapOptions& options) {
    const Skeleton& skeleton = character.skeleton;
    if (skeleton.jointCount() == 0) return refused("it has no joints");
    if (skeleton.jointCount() < kFewestJoints) {
        return refused(fmt::format("{} joint{} too few for a trunk, two arms and two legs", skeleton.jointCount(),
                                   skeleton.jointCount() == 1 ? " is" : "s are"));
    }
    const FixedJoints ofFile = options.useFileHumanoid ? jointsOfFile(character) : FixedJoints{};
    FixedJoints known = ofFile;
    for (int index = 0; index < kRoleCount; ++index) {
        if (options.fixed[index]) known[index] = options.fixed[index];
    }
    RigFeatures rig = readRig(character, options.useNames);
    teachFixed(known, rig);
    const Reading reading = readFigure(rig);
    const Figure& figure = reading.figure;
    const std::optional<quat> knownStance = stanceOfBindings(known, skeleton);
    HumanoidMap map =
        figure.refusal.empty()
            ? assembleRoles(figure, rig)
            : refused(floatsHandsAndFeet(rig) ? "its hands and feet hang on no arms and legs" : figure.refusal);
    if (!map.humanoid && !knownStance) return map;
    if (map.humanoid) addWarnings(figure, map);
    if (map.humanoid && reading.ofImages) tellMissingLimbs(map);
    if (knownStance) {
        // Who named hips, arms and legs has settled that it is a humanoid, and its left and right.
        if (!map.humanoid) map.warnings.clear();
        map.humanoid = true;
        map.confidence = std::max(map.confidence, 0.9F);
        map.standardFromModel = *knownStance;
    }
    const bool wholeFile = ofFile[indexOf(Role::hips)] && ofFile[indexOf(Role::head)] && knownStance;
    if (wholeFile) map.roles.fill(std::nullopt);  // roles that the file leaves out it has none for
    bindFixed(ofFile, "the file's own VRM humanoid block", map);
    bindFixed(options.fixed, "fixed by the user", map);
    questionFixed(options.fixed, skeleton, map);
    listMissing(map);
    const auto missing = static_cast<int>(map.missing.size());
    if (missing > kMostMissing) {
        map.warnings.push_back(
            fmt::format("{} of the 15 required parts have no joint: the ragdoll has hardly half a body", missing));
    }
    return map;
}

HumanoidMap mapWithoutCrowds(const WithoutCrowds& few, int leftOut, MapOptions options) {
    for (auto& joint : options.fixed) {
        if (joint) joint = few.placeOf(*joint);
    }
    HumanoidMap map = mapWhole(few.character, options);
    for (auto& binding : map.roles) {
        if (binding) binding->joint = few.originalOf(binding->joint);
    }
    if (!map.humanoid && !map.warnings.empty())
        map.warnings.front() += fmt::format(" (without {} small parts side by side)", leftOut);
    return map;
}

}  // namespace

HumanoidMap mapHumanoid(const Character& character, const MapOptions& options) {
    const Skeleton& skeleton = character.skeleton;
    for (const auto& joint : options.fixed)
        LUTKA_ASSERT(!joint || (*joint >= 0 && *joint < skeleton.jointCount()));
    if (const auto few = leaveOutCrowds(character, namedJoints(character, options), options.useNames))
        return mapWithoutCrowds(*few, skeleton.jointCount() - few->character.skeleton.jointCount(), options);
    return mapWhole(character, options);
}

}  // namespace lutka::animation
