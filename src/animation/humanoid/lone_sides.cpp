#include "animation/humanoid/lone_sides.hpp"

namespace lutka::animation {
namespace {

constexpr float kOtherPart = 0.0F;    // of a name's score: below it the name is another part's
constexpr float kNameToSkin = 0.05F;  // share of the skin that one unit of a name's score outweighs

// The joint below `joint` that goes on with the limb: by its name, then by its skin; kNoJoint when there is none.
int nextOnSide(const FramedRig& framed, int joint, Part part) {
    const RigFeatures& rig = *framed.rig;
    int best = kNoJoint;
    float bestScore = 0.0F;
    for (const int child : rig.children[joint]) {
        const NameEvidence& name = rig.names[child];
        const bool otherPart = name.meaningful && name.parts[part] < kOtherPart;
        const bool held = rig.hangsRigidlyOnSkin(child) && !name.meaningful;  // in the hand
        if (framed.pairOf[child] >= 0 || otherPart || held || name.helper || rig.shadow[child] ||
            !rig.carriesSkin(child))
            continue;
        const float score = rig.subtreeWeight[child] + kNameToSkin * name.parts[part] + 1e-6F;
        if (score <= bestScore) continue;
        bestScore = score;
        best = child;
    }
    return best;
}

}  // namespace

void findLoneSides(const FramedRig& framed, LimbCandidate& limb) {
    const std::array<Part, 4> parts = partsOf(limb.kind);
    constexpr std::size_t kEnd = 2;
    std::size_t last = kEnd;
    while (last > 0 && limb.pairs[last] == kNoPair)
        --last;
    if (limb.pairs[last] == kNoPair || limb.pairs[0] == kNoPair) return;
    const std::size_t slots = limb.kind == LimbKind::leg ? parts.size() : kEnd + 1;
    for (std::size_t side = 0; side < limb.lone.size(); ++side) {
        int joint = framed.pairs[limb.pairs[last]].joints[side];
        for (std::size_t slot = last + 1; slot < slots && joint != kNoJoint; ++slot) {
            if (limb.pairs[slot] != kNoPair) break;
            joint = nextOnSide(framed, joint, parts[slot]);
            limb.lone[side][slot] = joint;
        }
    }
}

}  // namespace lutka::animation
