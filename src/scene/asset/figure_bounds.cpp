#include "scene/asset/figure_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "scene/asset/body_bounds.hpp"

namespace lutka::scene {

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
    return bounds;
}

Figure figureOf(const RagdollAsset& asset) {
    return {figureBounds(asset.profile, asset.rig), asset.profile.standardFromModel};
}

}  // namespace lutka::scene
