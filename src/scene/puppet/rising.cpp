#include "scene/puppet/rising.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace lutka::scene {
namespace {

constexpr float kRestSpeed = 0.12F;   // m/s, root of the mean square by mass: slower is at rest
constexpr float kRestTurn = 3.0F;     // rad/s of any body: a hand that still swings is hardly felt in the mean
constexpr float kRestSeconds = 0.3F;  // for so long, before it gets up
constexpr float kSlowStart = 0.4F;    // of the clip's speed, while the doll is still on its way into it
constexpr float kLagM = 0.06F;        // a foot that is farther behind its aim slows the clip down,
constexpr float kMostLagM = 0.16F;    // so much that it hardly goes on
constexpr float kMostWaitSeconds = 0.5F;
constexpr float kLeastPace = 0.06F;  // of the clip's speed

}  // namespace

bool Rising::watch(const physics::RagdollProfile& profile, std::span<const physics::BodyState> bodies, bool isAsleep,
                   float dt) {
    match_.reset();
    float energy = 0.0F;
    float mass = 0.0F;
    float turn = 0.0F;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        turn = std::max(turn, glm::length(bodies[i].angularVelocity));
        const float m = profile.bodies[i].massKg;
        energy += m * glm::dot(bodies[i].linearVelocity, bodies[i].linearVelocity);
        mass += m;
    }
    const bool isSlow = energy < mass * kRestSpeed * kRestSpeed && turn < kRestTurn;
    rest_ = isSlow || isAsleep ? rest_ + dt : 0.0F;
    return rest_ >= kRestSeconds;
}

void Rising::begin(const GetUpClips::Match& match) {
    match_ = match;
    clipSeconds_ = match.seconds;
    waited_ = 0.0F;
    seconds_ = rest_;
    joints_.clear();
}

void Rising::advance(float dt, float footLagM, float blended) {
    seconds_ += dt;
    // Some feet never come: it waits for less and less.
    const float least = std::max(kLeastPace, waited_ / kMostWaitSeconds);
    const float keepsUp = std::clamp((kMostLagM - footLagM) / (kMostLagM - kLagM), std::min(least, 1.0F), 1.0F);
    waited_ += dt * (1.0F - keepsUp);
    pace_ = keepsUp * (kSlowStart + (1.0F - kSlowStart) * blended);
    clipSeconds_ += dt * pace_;
}

std::optional<Rising::Turn> Rising::turnOfStep(const physics::RagdollProfile& profile,
                                               std::span<const RigidTransform> worldFromBody) {
    const bool isFirst = joints_.empty();
    joints_.resize(profile.constraints.size());
    Turn most;
    for (std::size_t i = 0; i < profile.constraints.size(); ++i) {
        const physics::ConstraintProfile& joint = profile.constraints[i];
        const quat now = glm::conjugate(worldFromBody[joint.parent].rotation) * worldFromBody[joint.child].rotation;
        const quat step = glm::normalize(now * glm::conjugate(joints_[i]));
        joints_[i] = now;
        const float turned = degrees(glm::length(rotationVector(step)));
        if (turned > most.degrees) most = {turned, static_cast<int>(i)};
    }
    if (isFirst || most.constraint < 0) return std::nullopt;
    return most;
}

}  // namespace lutka::scene
