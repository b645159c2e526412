#include "animation/humanoid/named_stance.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "animation/humanoid/tails.hpp"

namespace lutka::animation {
namespace {

bool isNamedHips(const RigFeatures& rig) {
    return rig.namedJoint(Part::hips, Side::center, kTellsTrunkEnd) != kNoJoint;
}

// A limb of one or two joints ends at the last: nothing that moves skin hangs on it.
bool endsAt(const RigFeatures& rig, int joint) {
    const std::vector<int>& below = rig.children[joint];
    return std::none_of(below.begin(), below.end(), [&](int child) { return rig.carriesSkin(child); });
}

// The last of a neck's joints carries the head.
bool isNamedHead(const RigFeatures& rig) {
    if (rig.namedJoint(Part::head, Side::center, kTellsTrunkEnd) != kNoJoint) return true;
    for (int joint = 0; joint < rig.count(); ++joint) {
        const NameEvidence& name = rig.names[joint];
        const bool neck = name.side == Side::center && !name.helper && name.parts[Part::neck] >= kTellsTrunkEnd;
        if (neck && rig.carriesSkin(joint) && endsAt(rig, joint)) return true;
    }
    return false;
}

// Many rigs call the hips "root" or count them to the spine: then they are the joint that both thighs hang on, with so
// many joints (halves of the pelvis) between at most.
bool carriesThighs(const RigFeatures& rig, int mostBetween) {
    const int left = rig.namedJoint(Part::upperLeg, Side::left, kTellsPartOfLimb);
    const int right = rig.namedJoint(Part::upperLeg, Side::right, kTellsPartOfLimb);
    if (left == kNoJoint || right == kNoJoint) return false;
    const int above = rig.commonAncestor(left, right);
    return above != kNoJoint && std::max(rig.depth[left], rig.depth[right]) - rig.depth[above] <= mostBetween + 1 &&
           rig.names[above].side == Side::center && rig.names[above].parts[Part::hips] >= 0.0F;
}

// Where the spine is numbered up to the head, eyes and ears tell that there is one.
bool hasFace(const RigFeatures& rig) {
    return std::count_if(rig.names.begin(), rig.names.end(), [](const NameEvidence& name) { return name.face; }) >= 2;
}

bool namesTrunk(const RigFeatures& rig) {
    if (isNamedHead(rig)) return isNamedHips(rig) || carriesThighs(rig, 1);
    return hasFace(rig) && (isNamedHips(rig) || carriesThighs(rig, 0));
}

bool namesLimb(const RigFeatures& rig, const std::array<Part, 3>& parts, Side side) {
    const int upper = rig.namedJoint(parts[0], side, kTellsPartOfLimb);
    const int lower = rig.namedJoint(parts[1], side, kTellsPartOfLimb);
    if (upper == kNoJoint) return false;
    if (lower == kNoJoint) return endsAt(rig, upper);
    return rig.namedJoint(parts[2], side, kTellsPartOfLimb) != kNoJoint || endsAt(rig, lower);
}

bool namesWholeFigure(const RigFeatures& rig) {
    for (const auto& limb : {std::array{Part::upperArm, Part::lowerArm, Part::hand},
                             std::array{Part::upperLeg, Part::lowerLeg, Part::foot}}) {
        if (!namesLimb(rig, limb, Side::left) || !namesLimb(rig, limb, Side::right)) return false;
    }
    return namesTrunk(rig);
}

}  // namespace

std::optional<Stance> stanceOfNames(const RigFeatures& rig) {
    if (hasTail(rig) || !namesWholeFigure(rig)) return std::nullopt;
    const auto at = [&](Part part, Side side) { return rig.positions[rig.namedJoint(part, side, kTellsPartOfLimb)]; };
    const vec3 legs = at(Part::upperLeg, Side::left) + at(Part::upperLeg, Side::right);
    const vec3 arms = at(Part::upperArm, Side::left) + at(Part::upperArm, Side::right);
    const vec3 rise = 0.5F * (arms - legs);
    vec3 left = at(Part::upperLeg, Side::left) - at(Part::upperLeg, Side::right) + at(Part::upperArm, Side::left) -
                at(Part::upperArm, Side::right);
    if (glm::length(rise) <= 0.0F) return std::nullopt;
    const vec3 up = glm::normalize(rise);
    left -= glm::dot(left, up) * up;
    if (glm::length(left) <= 1e-3F * glm::length(rise)) return std::nullopt;
    Stance stance;
    stance.up = up;
    stance.plane.normal = glm::normalize(left);
    stance.plane.middle = 0.25F * (legs + arms);
    stance.plane.offset = glm::dot(stance.plane.middle, stance.plane.normal);
    stance.plane.agreement = 0.0F;
    stance.byNames = true;
    return stance;
}

}  // namespace lutka::animation
