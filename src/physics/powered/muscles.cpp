#include "physics/powered/muscles.hpp"

namespace lutka::physics {

MuscleGroup muscleGroupOf(const BodyProfile& body) {
    if (!body.role) return MuscleGroup::trunk;
    switch (*body.role) {
        case Role::neck:
        case Role::head:
            return MuscleGroup::head;
        case Role::leftShoulder:
        case Role::leftUpperArm:
        case Role::leftLowerArm:
        case Role::leftHand:
        case Role::rightShoulder:
        case Role::rightUpperArm:
        case Role::rightLowerArm:
        case Role::rightHand:
            return MuscleGroup::arm;
        case Role::leftUpperLeg:
        case Role::leftLowerLeg:
        case Role::leftFoot:
        case Role::leftToes:
        case Role::rightUpperLeg:
        case Role::rightLowerLeg:
        case Role::rightFoot:
        case Role::rightToes:
            return MuscleGroup::leg;
        default:
            return MuscleGroup::trunk;
    }
}

float strengthOf(const MuscleSettings& muscles, const RagdollProfile& profile, int body) {
    const auto group = static_cast<std::size_t>(muscleGroupOf(profile.bodies[body]));
    const auto at = static_cast<std::size_t>(body);
    return muscles.strength * muscles.groups[group] * (at < muscles.bodies.size() ? muscles.bodies[at] : 1.0F);
}

MuscleSettings musclesOf(MusclePreset preset) {
    MuscleSettings muscles;
    switch (preset) {
        case MusclePreset::limp:
            muscles.frequencyHz = 0.0F;
            break;
        case MusclePreset::weak:
            muscles.frequencyHz = 1.5F;
            break;
        case MusclePreset::powered:
            break;
        case MusclePreset::stiff:
            muscles.frequencyHz = 30.0F;
            muscles.bounded = false;
            break;
    }
    return muscles;
}

}  // namespace lutka::physics
