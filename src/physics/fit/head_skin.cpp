#include "physics/fit/head_skin.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace lutka::physics {
namespace {

float skinArea(const std::vector<SkinPoint>& skin) {
    float sum = 0.0F;
    for (const SkinPoint& point : skin)
        sum += point.area;
    return sum;
}

// The neck's joint may move most of the head; its skin is that of the body below.
void takeFromBelow(PlannedBody& below, PlannedBody& head) {
    std::vector<SkinPoint>& skin = below.skin;
    const vec3 way = head.start - below.start;
    if (!(glm::length(way) > 0.0F)) return;
    const auto beyond = std::stable_partition(skin.begin(), skin.end(), [&](const SkinPoint& point) {
        return glm::dot(point.position - head.start, way) <= 0.0F;
    });
    const std::vector<SkinPoint> taken(beyond, skin.end());
    if (skinArea(taken) <= skinArea(head.skin)) return;
    head.skin.insert(head.skin.end(), taken.begin(), taken.end());
    skin.erase(beyond, skin.end());
}

}  // namespace

std::vector<bool> jointsHangingOnHead(const BodyPlan& plan, const animation::Character& character,
                                      std::span<const animation::Appendage> appendages) {
    std::vector<bool> hangs(plan.bodyOfJoint.size(), false);
    const int head = plan.bodyOf(Role::head);
    if (head < 0) return hangs;
    for (const animation::Appendage& appendage : appendages) {
        if (appendage.role == Role::head) hangs[static_cast<std::size_t>(appendage.joint)] = true;
    }
    for (std::size_t joint = 0; joint < hangs.size(); ++joint) {
        const int parent = character.skeleton.parents[joint];
        if (parent >= 0 && hangs[static_cast<std::size_t>(parent)]) hangs[joint] = true;
    }
    for (std::size_t joint = 0; joint < hangs.size(); ++joint)
        hangs[joint] = hangs[joint] && plan.bodyOfJoint[joint] == head;
    return hangs;
}

void hangOnHead(BodyPlan& plan, const std::vector<SkinPoint>& hanging) {
    const int head = plan.bodyOf(Role::head);
    if (head < 0) return;
    std::vector<SkinPoint>& skin = plan.bodies[head].skin;
    skin.insert(skin.end(), hanging.begin(), hanging.end());
}

void settleHeadSkin(BodyPlan& plan, const std::vector<SkinPoint>& hanging) {
    constexpr float kLeastOwn = 0.01F;  // of the height's square; a man's head has 0.04
    const int index = plan.bodyOf(Role::head);
    if (index < 0) return;
    PlannedBody& head = plan.bodies[index];
    const float own = skinArea(head.skin) - skinArea(hanging);
    if (own >= kLeastOwn * plan.heightM * plan.heightM) head.skin.resize(head.skin.size() - hanging.size());
    if (head.parent >= 0) takeFromBelow(plan.bodies[head.parent], head);
}

}  // namespace lutka::physics
