#include <algorithm>

#include "animation/humanoid/limb_candidates.hpp"

namespace lutka::animation {

bool LimbCandidate::uses(int pair) const {
    return std::find(pairs.begin(), pairs.end(), pair) != pairs.end();
}

int LimbCandidate::jointCount() const {
    return static_cast<int>(std::count_if(pairs.begin(), pairs.begin() + 3, [](int pair) { return pair != kNoPair; }));
}

std::array<Part, 4> partsOf(LimbKind kind) {
    if (kind == LimbKind::leg) return {Part::upperLeg, Part::lowerLeg, Part::foot, Part::toes};
    return {Part::upperArm, Part::lowerArm, Part::hand, Part::clavicle};
}

}  // namespace lutka::animation
