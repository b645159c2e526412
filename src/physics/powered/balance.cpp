#include "physics/powered/balance.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "physics/collision/shape.hpp"

namespace lutka::physics {
namespace {

constexpr float kGain = 2.5F;       // of the torque that the capture point's distance asks for
constexpr float kFootShare = 0.9F;  // of a foot's half length that it presses within
constexpr float kLeastHeightM = 0.05F;

vec3 level(const vec3& v) {
    return {v.x, 0.0F, v.z};
}

}  // namespace

Balance::Balance(const RagdollProfile& profile) : profile_(profile) {
    for (const BodyProfile& body : profile.bodies)
        massKg_ += body.massKg;
    constexpr std::array<Role, 2> kFeet{Role::leftFoot, Role::rightFoot};
    for (std::size_t side = 0; side < kFeet.size(); ++side) {
        feet_[side] = bodyOf(profile, kFeet[side]);
        // constraints[i].child == i + 1
        for (int body = feet_[side]; body > 0; body = profile.constraints[body - 1].parent)
            if (const auto role = profile.bodies[body].role; role && !animation::isSpine(*role))
                legs_[side].push_back(body - 1);
    }
    stance_.share.resize(profile.constraints.size());
    stance_.torque.resize(profile.constraints.size());
}

const Stance* Balance::stanceOf(std::span<const BodyState> bodies, const std::array<bool, 2>& grounded, float gravity) {
    const int count = static_cast<int>(std::count(grounded.begin(), grounded.end(), true));
    std::fill(stance_.share.begin(), stance_.share.end(), 0.0F);
    std::fill(stance_.torque.begin(), stance_.torque.end(), vec3(0));
    if (count == 0 || massKg_ <= 0.0F) return nullptr;
    vec3 centre(0);
    vec3 velocity(0);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const float share = profile_.bodies[i].massKg / massKg_;
        centre += share * bodies[i].worldFromBody.translation;
        velocity += share * bodies[i].linearVelocity;
    }
    vec3 feet(0);
    for (std::size_t side = 0; side < feet_.size(); ++side) {
        if (feet_[side] < 0 || !grounded[side]) continue;
        feet += bodies[feet_[side]].worldFromBody.translation / static_cast<float>(count);
    }
    const float height = std::max(centre.y - feet.y, kLeastHeightM);
    const vec3 off = level(centre - feet) + level(velocity) * std::sqrt(height / gravity);
    const float share = 1.0F / static_cast<float>(count);
    for (std::size_t side = 0; side < feet_.size(); ++side) {
        if (feet_[side] < 0 || !grounded[side]) continue;
        for (const int joint : legs_[side])
            stance_.share[joint] = share;
        if (legs_[side].empty()) continue;
        // No farther than the foot can press: half of its extent along the way.
        const float way = glm::length(off);
        if (way < 1e-5F) continue;
        const quat& turn = bodies[feet_[side]].worldFromBody.rotation;
        const float reach =
            kFootShare * supportExtent(profile_.bodies[feet_[side]].shape, glm::conjugate(turn) * (off / way));
        const vec3 pressed = off * (std::min(kGain * way, reach) / way);
        stance_.torque[legs_[side].front()] = glm::cross(vec3(0, 1, 0), pressed) * (massKg_ * gravity * share);
    }
    return &stance_;
}

}  // namespace lutka::physics
