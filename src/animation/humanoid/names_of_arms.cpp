#include "animation/humanoid/names_of_arms.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

namespace lutka::animation {

// "Shoulder, arm, hand" where nothing is an elbow. A shoulder that starts well beside the spine and is as long as the
// arm is the upper arm, and the arm the forearm.
void readShouldersAsArms(RigFeatures& rig) {
    constexpr float kSurely = 4.0F;  // a name's score: this part and no other
    constexpr float kMaybe = 2.0F;
    constexpr float kSurelyNot = -2.5F;
    constexpr float kAsLong = 0.7F;  // of the arm
    const auto isShoulder = [&](int joint) {
        const PartScores& parts = rig.names[joint].parts;
        return parts[Part::clavicle] >= kMaybe && parts[Part::clavicle] < kSurely && !rig.names[joint].helper;
    };
    const auto isOther = [&](int joint, Side side) {
        return rig.names[joint].side != side && rig.names[joint].side != Side::center && isShoulder(joint);
    };
    std::vector<std::pair<int, int>> found;
    for (int arm = 0; arm < rig.count(); ++arm) {
        const int shoulder = rig.parents[arm];
        const NameEvidence& name = rig.names[arm];
        if (shoulder == kNoJoint || !isShoulder(shoulder) || rig.names[shoulder].side != name.side) continue;
        if (!name.bareLimb || name.parts[Part::upperArm] < kMaybe || name.side == Side::center) continue;
        if (rig.skinned && (rig.directWeight[shoulder] <= 0.0F || rig.directWeight[arm] <= 0.0F)) continue;
        const std::vector<int>& below = rig.children[arm];
        const auto hand = std::find_if(below.begin(), below.end(), [&](int child) {
            return rig.names[child].parts[Part::hand] >= kSurely && rig.carriesSkin(child);
        });
        if (hand == below.end()) continue;
        const float length = glm::distance(rig.positions[shoulder], rig.positions[arm]);
        if (length < kAsLong * glm::distance(rig.positions[arm], rig.positions[*hand])) continue;
        // A clavicle starts at the spine, so that the other one starts near it.
        for (int other = 0; other < rig.count(); ++other) {
            if (!isOther(other, name.side) || rig.parents[other] != rig.parents[shoulder]) continue;
            if (glm::distance(rig.positions[shoulder], rig.positions[other]) > length)
                found.emplace_back(shoulder, arm);
        }
    }
    for (const auto& [shoulder, arm] : found) {
        rig.names[arm].bareLimb = false;
        for (const auto& [joint, part] : {std::pair{shoulder, Part::upperArm}, std::pair{arm, Part::lowerArm}}) {
            rig.names[joint].parts.values.fill(kSurelyNot);
            rig.names[joint].parts[part] = kSurely;
        }
    }
}

}  // namespace lutka::animation
