#include "scene/asset/skin_reach.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scene/asset/body_bounds.hpp"

namespace lutka::scene {
namespace {

constexpr float kBeyond = 0.03F;  // of the figure's height
constexpr int kDirections = 26;

/// The farthest points that were seen in each direction.
struct Outermost {
    std::array<float, kDirections> along;
    std::array<vec3, kDirections> point{};
    bool any = false;

    Outermost() { along.fill(-1e9F); }
};

constexpr std::array<vec3, kDirections> directions() {
    std::array<vec3, kDirections> all{};
    int at = 0;
    for (int i = 0; i < 27; ++i) {
        if (i == 13) continue;  // none
        const int x = i % 3 - 1;
        const int y = i / 3 % 3 - 1;
        const int z = i / 9 - 1;
        all[static_cast<std::size_t>(at++)] = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
    }
    return all;
}

// One a joint: that of the joint, or of the nearest one above it that has a body.
std::vector<int> bodiesOfJoints(const RagdollAsset& asset) {
    const std::vector<int>& parents = asset.character.skeleton.parents;
    std::vector<int> bodies(parents.size(), -1);
    for (std::size_t body = 0; body < asset.rig.jointOfBody.size(); ++body)
        bodies[static_cast<std::size_t>(asset.rig.jointOfBody[body])] = static_cast<int>(body);
    for (std::size_t joint = 0; joint < parents.size(); ++joint) {
        if (bodies[joint] >= 0) continue;
        bodies[joint] = parents[joint] >= 0 ? bodies[static_cast<std::size_t>(parents[joint])] : 0;
    }
    return bodies;
}

void note(Outermost& outermost, const vec3& point) {
    static constexpr std::array<vec3, kDirections> ways = directions();
    outermost.any = true;
    for (std::size_t way = 0; way < ways.size(); ++way) {
        const float along = glm::dot(ways[way], point);
        if (along <= outermost.along[way]) continue;
        outermost.along[way] = along;
        outermost.point[way] = point;
    }
}

}  // namespace

std::vector<std::vector<vec3>> skinReach(const RagdollAsset& asset) {
    const std::size_t count = asset.profile.bodies.size();
    const std::vector<int> bodyOfJoint = bodiesOfJoints(asset);
    std::vector<RigidTransform> bodyFromModel;
    std::vector<vec3> half;
    for (std::size_t body = 0; body < count; ++body) {
        bodyFromModel.push_back(inverse(asset.rig.bindModelFromBody[body]));
        half.push_back(halfAabbOf(asset.profile.bodies[body].shape, quat(1, 0, 0, 0)));
    }
    const float beyond = kBeyond * asset.profile.heightM;
    std::vector<Outermost> outermost(count);
    for (const animation::SkinnedMesh& mesh : asset.character.meshes) {
        for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
            const auto body = static_cast<std::size_t>(bodyOfJoint[mesh.joints[vertex].front()]);
            const vec3 point = bodyFromModel[body] * mesh.positions[vertex];
            const vec3 outside = glm::max(glm::abs(point) - half[body], vec3(0));
            if (glm::dot(outside, outside) > beyond * beyond) note(outermost[body], point);
        }
    }
    std::vector<std::vector<vec3>> reach(count);
    for (std::size_t body = 0; body < count; ++body) {
        if (!outermost[body].any) continue;
        for (const vec3& point : outermost[body].point)
            if (std::find(reach[body].begin(), reach[body].end(), point) == reach[body].end())
                reach[body].push_back(point);
    }
    return reach;
}

}  // namespace lutka::scene
