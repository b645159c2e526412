#include "scene/puppet/standing_feet.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "physics/collision/shape.hpp"

namespace lutka::scene {
namespace {

constexpr float kFootStillMps = 0.06F;  // a foot of the pose that is slower stands
constexpr float kFootLowM = 0.03F;      // and is lower over the ground
constexpr float kFootFlat = radians(20.0F);

}  // namespace

StandingFeet::StandingFeet(const RagdollAsset& asset) : asset_(&asset) {
    feet_[0].body = physics::bodyOf(asset.profile, physics::Role::leftFoot);
    feet_[1].body = physics::bodyOf(asset.profile, physics::Role::rightFoot);
}

void StandingFeet::release() {
    for (Foot& foot : feet_)
        foot.stands = false;
}

bool StandingFeet::standsInPose(int body, const Step& step) const {
    const RigidTransform& aim = step.to[body];
    const animation::GroundHit ground = step.ground(aim.translation);
    const quat off = aim.rotation * glm::conjugate(asset_->rig.bindModelFromBody[body].rotation) *
                     glm::conjugate(asset_->map.standardFromModel);
    const vec3 up = off * vec3(0, 1, 0);
    const vec3 onGround(aim.translation.x, ground.height, aim.translation.z);
    const float above =
        glm::dot(aim.translation - onGround, ground.normal) -
        physics::supportExtent(asset_->profile.bodies[body].shape, glm::conjugate(aim.rotation) * -ground.normal);
    return glm::distance(aim.translation, step.from[body].translation) < kFootStillMps * step.dt * step.pace &&
           above < kFootLowM && glm::dot(up, ground.normal) > std::cos(kFootFlat);
}

float StandingFeet::slideAfter(const Step& step) {
    float most = -1.0F;
    for (Foot& foot : feet_) {
        if (foot.body < 0) continue;
        const bool stands = standsInPose(foot.body, step);
        const vec3 at = step.bodies[foot.body].translation;
        if (stands && !foot.stands) foot.at = at;
        foot.stands = stands;
        if (stands) most = std::max(most, std::hypot(at.x - foot.at.x, at.z - foot.at.z));
    }
    return most;
}

void StandingFeet::hold(physics::Puppet& puppet, std::span<const physics::BodyState> bodies, float forceN) const {
    for (const Foot& foot : feet_) {
        if (!foot.stands) continue;
        // As it is turned now, or the pull would snap a light foot over.
        const RigidTransform& now = bodies[foot.body].worldFromBody;
        puppet.hold(foot.body, {now.rotation, {foot.at.x, now.translation.y, foot.at.z}}, forceN);
    }
}

}  // namespace lutka::scene
