#include "animation/playback/inertial_blend.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/assert.hpp"

namespace lutka::animation {
namespace {

// The steepest slope of 1 - 10 t³ + 15 t⁴ - 6 t⁵.
constexpr float kSteepest = 1.875F;

vec3 turnBetween(const quat& to, const quat& from) {
    return rotationVector(glm::normalize(from * glm::conjugate(to)));
}

quat turnOf(const vec3& vector) {
    const float angle = glm::length(vector);
    return angle > 1e-7F ? glm::angleAxis(angle, vector / angle) : quat(1, 0, 0, 0);
}

}  // namespace

void InertialBlend::begin(std::span<const RigidTransform> fromBefore, std::span<const RigidTransform> from,
                          std::span<const RigidTransform> toBefore, std::span<const RigidTransform> to, float dt,
                          const InertialSettings& settings) {
    LUTKA_ASSERT(from.size() == to.size() && fromBefore.size() == from.size() && toBefore.size() == to.size());
    LUTKA_ASSERT(dt > 0.0F);
    offsets_.resize(from.size());
    float needed = settings.leastSeconds;
    for (std::size_t i = 0; i < from.size(); ++i) {
        Offset& offset = offsets_[i];
        offset.turn = turnBetween(to[i].rotation, from[i].rotation);
        offset.turnRate = (offset.turn - turnBetween(toBefore[i].rotation, fromBefore[i].rotation)) / dt;
        // Of two ways around the rotation vector is the shorter one; a step across half a turn is no velocity.
        if (glm::length(offset.turnRate) * dt > kPi * 0.5F) offset.turnRate = vec3(0);
        offset.shift = from[i].translation - to[i].translation;
        offset.shiftRate = (offset.shift - (fromBefore[i].translation - toBefore[i].translation)) / dt;
        needed = std::max({needed, kSteepest * glm::length(offset.turn) / settings.turnRate,
                           kSteepest * glm::length(offset.shift) / settings.speed});
    }
    seconds_ = std::min(needed, settings.mostSeconds);
    passed_ = 0.0F;
}

void InertialBlend::apply(std::span<RigidTransform> frames) const {
    if (isOver()) return;
    LUTKA_ASSERT(frames.size() == offsets_.size());
    // Quintics that end at 0 with all of their slopes: one begins at 1, the other with a slope of 1.
    const float t = passed_ / seconds_;
    const float place = 1.0F + t * t * t * (-10.0F + t * (15.0F - 6.0F * t));
    const float slope = seconds_ * t * (1.0F + t * t * (-6.0F + t * (8.0F - 3.0F * t)));
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Offset& offset = offsets_[i];
        frames[i].rotation = glm::normalize(turnOf(offset.turn * place + offset.turnRate * slope) * frames[i].rotation);
        frames[i].translation += offset.shift * place + offset.shiftRate * slope;
    }
}

}  // namespace lutka::animation
