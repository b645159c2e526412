#include "physics/powered/muscles.hpp"

#include <algorithm>

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

float boundedProduct(float a, float b) {
    return std::min(a * b, MuscleFactors::kMost);
}

MuscleFactors factorsOf(const MuscleSettings& muscles, const RagdollProfile& profile, int body) {
    MuscleFactors factors = muscles.groups[static_cast<std::size_t>(muscleGroupOf(profile.bodies[body]))];
    const auto at = static_cast<std::size_t>(body);
    if (at >= muscles.bodies.size()) return factors;
    factors.strength = boundedProduct(factors.strength, muscles.bodies[at].strength);
    factors.damping = boundedProduct(factors.damping, muscles.bodies[at].damping);
    factors.torque = boundedProduct(factors.torque, muscles.bodies[at].torque);
    return factors;
}

float strengthOf(const MuscleSettings& muscles, const RagdollProfile& profile, int body) {
    return boundedProduct(muscles.strength, factorsOf(muscles, profile, body).strength);
}

MuscleSettings musclesOf(MusclePreset preset) {
    return {muscleProfileOf(preset), {}, vec3(0)};
}

std::optional<MuscleSettings> musclesOf(const RagdollProfile& profile, const vec3& gravity) {
    if (!profile.muscles) return std::nullopt;
    MuscleSettings muscles{*profile.muscles, {}, profile.muscles->carriesGravity ? gravity : vec3(0)};
    muscles.bodies.reserve(profile.bodies.size());
    for (const BodyProfile& body : profile.bodies)
        muscles.bodies.push_back(body.muscle);
    return muscles;
}

}  // namespace lutka::physics
