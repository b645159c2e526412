#include "animation/humanoid/names_of_trunk.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace lutka::animation {
namespace {

constexpr float kTellsOnePart = 4.0F;  // a name's score: this part and no other

bool saysHips(const NameEvidence& name) {
    return name.side == Side::center && !name.helper && name.parts[Part::hips] >= kTellsOnePart;
}

bool saysLeg(const NameEvidence& name) {
    return !name.helper && name.side != Side::center &&
           std::max({name.parts[Part::upperLeg], name.parts[Part::lowerLeg], name.parts[Part::foot]}) >=
               kTellsPartOfLimb;
}

bool carriesLegs(const RigFeatures& rig, int joint) {
    for (int below = 0; below < rig.count(); ++below)
        if (rig.isAncestorOrSelf(joint, below) && saysLeg(rig.names[below])) return true;
    return false;
}

// Whether both thighs hang on that joint, by their names.
bool carriesBothThighs(const RigFeatures& rig, int joint) {
    const auto has = [&](Side side) {
        return std::any_of(rig.children[joint].begin(), rig.children[joint].end(), [&](int child) {
            const NameEvidence& name = rig.names[child];
            return name.side == side && !name.helper && name.parts[Part::upperLeg] >= kTellsPartOfLimb;
        });
    };
    return has(Side::left) && has(Side::right);
}

// Some rigs call every hub where limbs hang "Pelvis", with numbers: rib cage and head, too. The one that carries the
// legs is the hips, and its name says nothing of what hangs on it.
void readRepeatedHubs(RigFeatures& rig) {
    std::vector<int> repeated;
    for (int hub = 0; hub < rig.count(); ++hub) {
        if (!saysHips(rig.names[hub]) || carriesLegs(rig, hub)) continue;
        int above = rig.parents[hub];
        while (above != kNoJoint && !(saysHips(rig.names[above]) && rig.names[above].words == rig.names[hub].words))
            above = rig.parents[above];
        if (above != kNoJoint && rig.names[above].numbers != rig.names[hub].numbers) repeated.push_back(hub);
    }
    for (const int hub : repeated)
        rig.names[hub].parts.values.fill(0.0F);
}

// A lower body that hangs, without the legs, on what carries both thighs and moves skin: the spine begins with it.
void readLowerBodies(RigFeatures& rig) {
    for (int joint = 0; joint < rig.count(); ++joint) {
        const int parent = rig.parents[joint];
        if (parent == kNoJoint || !saysHips(rig.names[joint]) || carriesLegs(rig, joint)) continue;
        const NameEvidence& above = rig.names[parent];
        const bool mayBeHips = above.side == Side::center && !above.helper && above.parts[Part::hips] >= 0.0F;
        if (!mayBeHips || !carriesBothThighs(rig, parent) || (rig.skinned && rig.directWeight[parent] <= 0.0F))
            continue;
        if (rig.positions[joint].y <= rig.positions[parent].y) continue;
        PartScores& parts = rig.names[joint].parts;
        parts[Part::hips] = 0.0F;
        parts[Part::trunk] = kTellsTrunkEnd;
    }
}

// Where no joint is named head, a helmet that moves skin or is a mesh, on a joint of the trunk, is one.
void readHelmets(RigFeatures& rig) {
    constexpr std::array<std::string_view, 3> kHelmets{"helmet", "hood", "headgear"};
    if (rig.namedJoint(Part::head, Side::center, kTellsTrunkEnd) != kNoJoint) return;
    std::vector<int> found;
    for (int joint = 0; joint < rig.count(); ++joint) {
        const NameEvidence& name = rig.names[joint];
        const bool carries = rig.directWeight[joint] > 0.0F || rig.rigidPart[joint];
        const bool named =
            !name.words.empty() && std::find(kHelmets.begin(), kHelmets.end(), name.words.back()) != kHelmets.end();
        if (named && name.side == Side::center && carries) found.push_back(joint);
    }
    if (found.size() != 1) return;
    NameEvidence& name = rig.names[found.front()];
    name.parts.values.fill(-kTellsTrunkEnd);
    name.parts[Part::head] = kTellsTrunkEnd;
    name.worn = false;
}

}  // namespace

void readNamesOfTrunk(RigFeatures& rig) {
    readRepeatedHubs(rig);
    readLowerBodies(rig);
    readHelmets(rig);
}

}  // namespace lutka::animation
