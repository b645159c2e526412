#include "physics/fit/radius_share.hpp"

namespace lutka::physics {

float radiusShare(Role role) {
    switch (sideOf(role) == animation::Side::right ? mirrored(role) : role) {
        case Role::hips:
        case Role::spine:
        case Role::chest:
        case Role::upperChest:
            return 0.068F;
        case Role::head:
            return 0.05F;
        case Role::neck:
            return 0.033F;
        case Role::leftShoulder:
            return 0.03F;
        case Role::leftUpperArm:
            return 0.028F;
        case Role::leftLowerArm:
            return 0.023F;
        case Role::leftUpperLeg:
            return 0.045F;
        case Role::leftLowerLeg:
            return 0.032F;
        case Role::leftToes:
            return 0.015F;
        default:
            return 0.02F;
    }
}

}  // namespace lutka::physics
