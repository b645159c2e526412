#include "editor/view/joint_pick.hpp"

#include <glm/geometric.hpp>

namespace lutka::editor {

int jointUnder(const animation::Skeleton& skeleton, std::span<const vec3> worldOfJoint, const render::Camera& camera,
               const vec2& mouse, render::Extent window, float pixels) {
    constexpr float together = 2.0F;  // pixels: joints this near to each other are at one place
    int best = animation::kNoJoint;
    float bestDistance = pixels;
    const auto deforms = [&](int joint) { return skeleton.skinWeight[joint] > 0.0F; };
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        const auto seen = render::project(camera, worldOfJoint[joint], window);
        if (!seen) continue;
        const float distance = glm::distance(vec2(*seen), mouse);
        if (distance >= pixels) continue;
        const bool beside = best != animation::kNoJoint && std::abs(distance - bestDistance) < together;
        const bool better = beside ? deforms(joint) && !deforms(best) : distance < bestDistance;
        if (!better) continue;
        best = joint;
        bestDistance = distance;
    }
    return best;
}

}  // namespace lutka::editor
