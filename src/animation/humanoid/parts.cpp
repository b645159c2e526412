#include "animation/humanoid/parts.hpp"

namespace lutka::animation {

Part partOf(Role role) {
    constexpr std::array<Part, 8> kSided{Part::clavicle, Part::upperArm, Part::lowerArm, Part::hand,
                                         Part::upperLeg, Part::lowerLeg, Part::foot,     Part::toes};
    constexpr std::array<Part, 6> kCentral{Part::hips, Part::trunk, Part::trunk, Part::chest, Part::neck, Part::head};
    const int index = indexOf(role);
    if (sideOf(role) == Side::center) return kCentral[static_cast<std::size_t>(index)];
    return kSided[static_cast<std::size_t>(index - indexOf(Role::leftShoulder)) % kSided.size()];
}

}  // namespace lutka::animation
