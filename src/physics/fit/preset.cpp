#include "physics/fit/preset.hpp"

#include <algorithm>
#include <array>

#include "core/assert.hpp"
#include "physics/fit/limits.hpp"

namespace lutka::physics {
namespace {

constexpr float kMost = radians(175.0F);

// A standing arm's weight turns its shoulder with about 8 N m; friction as fitted is a fortieth of such torques.
constexpr std::array kInfos = {
    PresetInfo{RagdollPreset::anatomical, "anatomical", "the ranges of a body, hardly any resistance", 1.0F, 1.0F,
               false},
    PresetInfo{RagdollPreset::loose, "loose", "wider limits, a quarter of the friction: flops", 1.3F, 0.25F, false},
    PresetInfo{RagdollPreset::stiff, "stiff", "narrower limits, eight times the friction: braces", 0.8F, 8.0F, false},
    PresetInfo{RagdollPreset::toy, "toy", "narrow limits, joints that hold a pose, mass by volume", 0.6F, 48.0F, true},
};

float scaled(float limit, float scale) {
    return std::clamp(limit * scale, -kMost, kMost);
}

}  // namespace

std::span<const PresetInfo> presetInfos() {
    return kInfos;
}

const PresetInfo& infoOf(RagdollPreset preset) {
    return kInfos[static_cast<std::size_t>(preset)];
}

void applyPreset(RagdollProfile& profile, RagdollPreset preset, std::span<const RigidTransform> bindFromBody) {
    LUTKA_ASSERT(bindFromBody.size() == profile.bodies.size());
    const PresetInfo& info = infoOf(preset);
    if (preset == RagdollPreset::anatomical) return;
    for (ConstraintProfile& constraint : profile.constraints) {
        constraint.hinge.lower = scaled(constraint.hinge.lower, info.limitScale);
        constraint.hinge.upper = scaled(constraint.hinge.upper, info.limitScale);
        constraint.cone.swingY = scaled(constraint.cone.swingY, info.limitScale);
        constraint.cone.swingZ = scaled(constraint.cone.swingZ, info.limitScale);
        constraint.cone.twist = scaled(constraint.cone.twist, info.limitScale);
        constraint.frictionNm *= info.frictionScale;
        std::string note = widenToHold(constraint, bindFromBody[constraint.parent], bindFromBody[constraint.child],
                                       profile.bodies[constraint.child].name);
        if (!note.empty()) profile.notes.push_back(std::move(note));
    }
}

}  // namespace lutka::physics
