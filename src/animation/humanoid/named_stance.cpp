#include "animation/humanoid/named_stance.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

namespace lutka::animation {
namespace {

constexpr float kNamedLimb = 1.5F;      // a name's score from which it says which part of a limb this is
constexpr float kNamedTrunkEnd = 2.0F;  // … or that it is the hips or the head

// The joint whose name says that part most clearly; of equals the one nearest to the root.
int namedJoint(const RigFeatures& rig, Part part, Side side, float least) {
    int best = kNoJoint;
    for (int joint = 0; joint < rig.count(); ++joint) {
        const NameEvidence& name = rig.names[joint];
        if (name.side != side || name.helper || name.parts[part] < least) continue;
        const auto rank = [&](int of) { return rig.names[of].parts[part] + (rig.carriesSkin(of) ? 1.0F : 0.0F); };
        const bool better = best == kNoJoint || rank(joint) > rank(best) ||
                            (rank(joint) == rank(best) && rig.depth[joint] < rig.depth[best]);
        if (better) best = joint;
    }
    return best;
}

bool hasTail(const RigFeatures& rig) {
    return std::any_of(rig.names.begin(), rig.names.end(), [](const NameEvidence& name) { return name.tail; });
}

// Many rigs call the hips "root" or count them to the spine: then they are the joint that both thighs hang on.
bool namesHips(const RigFeatures& rig) {
    if (namedJoint(rig, Part::hips, Side::center, kNamedTrunkEnd) != kNoJoint) return true;
    const int left = namedJoint(rig, Part::upperLeg, Side::left, kNamedLimb);
    const int right = namedJoint(rig, Part::upperLeg, Side::right, kNamedLimb);
    const int parent = left == kNoJoint ? kNoJoint : rig.parents[left];
    return parent != kNoJoint && right != kNoJoint && rig.parents[right] == parent &&
           rig.names[parent].side == Side::center && rig.names[parent].parts[Part::hips] >= 0.0F;
}

// Where the spine is numbered up to the head, eyes and ears tell that there is one.
bool namesHead(const RigFeatures& rig) {
    if (namedJoint(rig, Part::head, Side::center, kNamedTrunkEnd) != kNoJoint) return true;
    return std::count_if(rig.names.begin(), rig.names.end(), [](const NameEvidence& name) { return name.face; }) >= 2;
}

bool namesWholeFigure(const RigFeatures& rig) {
    constexpr std::array<Part, 6> kLimbs{Part::upperArm, Part::lowerArm, Part::hand,
                                         Part::upperLeg, Part::lowerLeg, Part::foot};
    for (const Part part : kLimbs) {
        if (namedJoint(rig, part, Side::left, kNamedLimb) == kNoJoint) return false;
        if (namedJoint(rig, part, Side::right, kNamedLimb) == kNoJoint) return false;
    }
    return namesHips(rig) && namesHead(rig);
}

}  // namespace

std::optional<Stance> stanceOfNames(const RigFeatures& rig) {
    if (hasTail(rig) || !namesWholeFigure(rig)) return std::nullopt;
    const auto at = [&](Part part, Side side) { return rig.positions[namedJoint(rig, part, side, kNamedLimb)]; };
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
