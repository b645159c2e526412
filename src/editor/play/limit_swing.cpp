#include "editor/play/limit_swing.hpp"

#include <algorithm>
#include <glm/common.hpp>

#include "core/assert.hpp"
#include "core/swing_twist.hpp"

namespace lutka::editor {
namespace {

constexpr float kSecondsPerStop = 0.7F;

}  // namespace

LimitSwing::LimitSwing(const physics::RagdollProfile& profile, int child, std::vector<RigidTransform> worldFromBody)
    : constraint_(profile.constraints[child - 1]), start_(std::move(worldFromBody)), shown_(start_) {
    LUTKA_ASSERT(child > 0 && start_.size() == profile.bodies.size());
    moving_.push_back(child);
    for (const physics::ConstraintProfile& below : profile.constraints) {
        if (std::find(moving_.begin(), moving_.end(), below.parent) != moving_.end()) moving_.push_back(below.child);
    }
    const physics::JointWords words = physics::jointWords(profile.bodies[child].role);
    const auto named = [](std::string_view name) { return std::string(name); };
    const quat relative = physics::relativeFrame(constraint_, {start_[constraint_.parent], start_[constraint_.child]});
    if (constraint_.kind == physics::ConstraintProfile::Kind::hinge) {
        const float now = std::remainder(2.0F * std::atan2(relative.z, relative.w), 2.0F * kPi);
        stops_ = {{0, now, 0, ""},
                  {0, constraint_.hinge.lower, 0, named(words.flexion.low)},
                  {0, constraint_.hinge.upper, 0, named(words.flexion.high)},
                  {0, now, 0, "back"}};
        return;
    }
    const SwingTwist now = swingTwist(relative);
    const physics::ConeTwistLimits& cone = constraint_.cone;
    stops_ = {{now.swing.y, now.swing.z, now.twist, ""},
              {0, -cone.swingZ, 0, named(words.flexion.low)},
              {0, cone.swingZ, 0, named(words.flexion.high)},
              {0, 0, 0, "middle"},
              {-cone.swingY, 0, 0, named(words.side.low)},
              {cone.swingY, 0, 0, named(words.side.high)},
              {0, 0, 0, "middle"},
              {0, 0, -cone.twist, named(words.twist.low)},
              {0, 0, cone.twist, named(words.twist.high)},
              {now.swing.y, now.swing.z, now.twist, "back"}};
}

bool LimitSwing::done() const {
    return seconds_ >= kSecondsPerStop * static_cast<float>(stops_.size() - 1);
}

std::string LimitSwing::text() const {
    const auto next = static_cast<std::size_t>(seconds_ / kSecondsPerStop) + 1;
    return stops_[std::min(next, stops_.size() - 1)].name;
}

void LimitSwing::advance(float seconds) {
    seconds_ += seconds;
    shown_ = start_;
    if (done()) return;
    const float at = seconds_ / kSecondsPerStop;
    const auto index = static_cast<std::size_t>(at);
    const float share = glm::smoothstep(0.0F, 1.0F, at - static_cast<float>(index));
    const Stop& from = stops_[index];
    const Stop& to = stops_[index + 1];
    const SwingTwist pose{{0, glm::mix(from.side, to.side, share), glm::mix(from.flexion, to.flexion, share)},
                          glm::mix(from.twist, to.twist, share)};
    const RigidTransform turn{rotationOf(pose), vec3(0)};
    const RigidTransform child =
        start_[constraint_.parent] * constraint_.parentFromFrame * turn * inverse(constraint_.childFromFrame);
    const RigidTransform moved = child * inverse(start_[constraint_.child]);
    for (const int body : moving_) {
        shown_[body] = moved * start_[body];
        shown_[body].rotation = glm::normalize(shown_[body].rotation);
    }
}

}  // namespace lutka::editor
