#include "scene/asset/figure_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "physics/collision/shape.hpp"
#include "scene/asset/body_bounds.hpp"

namespace lutka::scene {
namespace {

// From `entry`, a point of the body in model space, over joint after joint away from `from` to the farthest surface.
float reachFrom(const physics::RagdollProfile& profile, const physics::Rig& rig, int body, const vec3& entry,
                int from) {
    const RigidTransform& modelFromBody = rig.bindModelFromBody[body];
    float reach = glm::distance(entry, modelFromBody.translation) + physics::boundingRadius(profile.bodies[body].shape);
    for (const physics::ConstraintProfile& joint : profile.constraints) {
        if (joint.parent != body && joint.child != body) continue;
        const int next = joint.parent == body ? joint.child : joint.parent;
        if (next == from) continue;
        const vec3 anchor = rig.bindModelFromBody[joint.child] * joint.childFromFrame.translation;
        reach = std::max(reach, glm::distance(entry, anchor) + reachFrom(profile, rig, next, anchor, body));
    }
    return reach;
}

}  // namespace

vec3 bodyFromHold(const physics::RagdollProfile& profile, const physics::Rig& rig, int body) {
    const physics::BodyShape& shape = profile.bodies[body].shape;
    if (shape.kind != physics::BodyShape::Kind::capsule) return vec3(0);
    const vec3 up(0, shape.halfLength, 0);
    const vec3& joint = rig.bodyFromJoint[body].translation;
    return glm::distance(up, joint) > glm::distance(-up, joint) ? up : -up;
}

FigureBounds figureBounds(const physics::RagdollProfile& profile, const physics::Rig& rig) {
    FigureBounds bounds{vec3(1e9F), vec3(-1e9F)};
    const auto standardFrom = [&](std::size_t body) {
        return RigidTransform{profile.standardFromModel, vec3(0)} * rig.bindModelFromBody[body];
    };
    const auto boxOf = [&](std::size_t body) {
        const RigidTransform standardFromBody = standardFrom(body);
        const vec3 half = halfAabbOf(profile.bodies[body].shape, standardFromBody.rotation);
        return FigureBounds{standardFromBody.translation - half, standardFromBody.translation + half};
    };
    for (std::size_t body = 0; body < profile.bodies.size(); ++body) {
        const FigureBounds box = boxOf(body);
        bounds.low = glm::min(bounds.low, box.low);
        bounds.high = glm::max(bounds.high, box.high);
        bounds.bodies.push_back({profile.bodies[body].shape, standardFrom(body)});
    }
    // It stands on what comes within a twentieth of its height to the ground.
    const float ground = bounds.low.y + 0.05F * (bounds.high.y - bounds.low.y);
    const vec3 middle = 0.5F * (bounds.low + bounds.high);
    for (std::size_t body = 0; body < profile.bodies.size(); ++body) {
        const FigureBounds box = boxOf(body);
        if (box.low.y > ground) continue;
        const vec3 reach = glm::max(glm::abs(box.low - middle), glm::abs(box.high - middle));
        bounds.stance = std::max(bounds.stance, std::hypot(reach.x, reach.z));
    }
    using physics::Role;
    for (const Role role : {Role::leftHand, Role::leftLowerArm, Role::leftUpperArm}) {
        const int hand = physics::bodyOf(profile, role);
        if (hand < 0) continue;
        bounds.handBody = profile.bodies[static_cast<std::size_t>(hand)].name;
        const vec3 hold = bodyFromHold(profile, rig, hand);
        bounds.hand = bounds.bodies[static_cast<std::size_t>(hand)].standardFromBody * hold;
        bounds.handReach = reachFrom(profile, rig, hand, rig.bindModelFromBody[hand] * hold, -1);
        break;
    }
    return bounds;
}

Figure figureOf(const RagdollAsset& asset) {
    return {figureBounds(asset.profile, asset.rig), asset.profile.standardFromModel};
}

}  // namespace lutka::scene
