#include "physics/fit/skin_regions.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "physics/fit/head_pieces.hpp"

namespace lutka::physics {
namespace {

using animation::SkinnedMesh;

int ownerOf(const SkinnedMesh& mesh, std::size_t vertex, const std::vector<int>& bodyOfJoint) {
    int owner = 0;
    float most = -1.0F;
    for (int i = 0; i < animation::kMaxInfluences; ++i) {
        const int body = bodyOfJoint[mesh.joints[vertex][i]];
        float sum = 0.0F;
        for (int k = 0; k < animation::kMaxInfluences; ++k) {
            if (bodyOfJoint[mesh.joints[vertex][k]] == body) sum += mesh.weights[vertex][k];
        }
        if (sum > most) {
            most = sum;
            owner = body;
        }
    }
    return owner;
}

float triangleArea(const SkinnedMesh& mesh, const std::uint32_t* corner) {
    const vec3& a = mesh.positions[corner[0]];
    return 0.5F * glm::length(glm::cross(mesh.positions[corner[1]] - a, mesh.positions[corner[2]] - a));
}

void addVertices(BodyPlan& plan, const SkinnedMesh& mesh, const std::vector<int>& owners, const mat3& toStandard) {
    std::vector<float> areas(mesh.positions.size(), 0.0F);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const float third = triangleArea(mesh, &mesh.indices[i]) / 3.0F;
        for (std::size_t k = 0; k < 3; ++k)
            areas[mesh.indices[i + k]] += third;
    }
    // In the file's order: neighbours follow each other in it, which the search for shapes draws its samples by.
    for (std::size_t place = 0; place < mesh.positions.size(); ++place) {
        const std::size_t vertex = mesh.fileOrder.empty() ? place : mesh.fileOrder[place];
        const vec3 at = toStandard * mesh.positions[vertex];
        plan.bodies[owners[vertex]].skin.push_back({at, areas[vertex], at});
    }
}

// Two points a corner: near the corner and between it and the middle; they belong to the corner's body.
void addTrianglePoints(BodyPlan& plan, const SkinnedMesh& mesh, const std::vector<int>& owners,
                       const mat3& toStandard) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t* corner = &mesh.indices[i];
        const float sixth = triangleArea(mesh, corner) / 6.0F;
        const vec3 middle = (mesh.positions[corner[0]] + mesh.positions[corner[1]] + mesh.positions[corner[2]]) / 3.0F;
        for (int k = 0; k < 3; ++k) {
            const vec3& at = mesh.positions[corner[k]];
            std::vector<SkinPoint>& skin = plan.bodies[owners[corner[k]]].skin;
            skin.push_back({toStandard * glm::mix(at, middle, 0.2F), sixth, toStandard * at});
            skin.push_back({toStandard * glm::mix(at, middle, 0.6F), sixth, toStandard * at});
        }
    }
}

float areaOf(const PlannedBody& body) {
    float sum = 0.0F;
    for (const SkinPoint& point : body.skin)
        sum += point.area;
    return sum;
}

// Mean height of a left and a right body's joints, or `otherwise`.
float heightOfPair(const BodyPlan& plan, Role left, float otherwise) {
    const int a = plan.bodyOf(left);
    const int b = plan.bodyOf(mirrored(left));
    return a >= 0 && b >= 0 ? 0.5F * (plan.bodies[a].start.y + plan.bodies[b].start.y) : otherwise;
}

// From the hips up.
std::vector<int> trunkBodies(const BodyPlan& plan) {
    std::vector<int> trunk;
    for (std::size_t body = 0; body < plan.bodies.size(); ++body) {
        if (isTrunk(plan.bodies[body].role)) trunk.push_back(static_cast<int>(body));
    }
    return trunk;
}

int trunkBodyAt(const BodyPlan& plan, const std::vector<int>& trunk, float height) {
    const auto above = std::upper_bound(plan.trunkBounds.begin(), plan.trunkBounds.end(), height);
    return trunk[static_cast<std::size_t>(above - plan.trunkBounds.begin())];
}

}  // namespace

std::vector<int> ownersOfVertices(const BodyPlan& plan, const SkinnedMesh& mesh, const mat3& standardFromModel) {
    std::vector<int> owners = bodiesOfVertices(mesh, plan.bodyOfJoint);
    if (plan.trunkBounds.empty()) return owners;
    const std::vector<int> trunk = trunkBodies(plan);
    for (std::size_t vertex = 0; vertex < owners.size(); ++vertex) {
        if (!isTrunk(plan.bodies[owners[vertex]].role)) continue;
        owners[vertex] = trunkBodyAt(plan, trunk, (standardFromModel * mesh.positions[vertex]).y);
    }
    return owners;
}

std::vector<int> bodiesOfVertices(const SkinnedMesh& mesh, const std::vector<int>& bodyOfJoint) {
    std::vector<int> owners(mesh.positions.size());
    for (std::size_t vertex = 0; vertex < owners.size(); ++vertex)
        owners[vertex] = ownerOf(mesh, vertex, bodyOfJoint);
    return owners;
}

std::vector<SkinPoint> gatherSkin(BodyPlan& plan, const animation::Character& character, const quat& standardFromModel,
                                  const std::vector<bool>& hanging, const std::vector<bool>& held) {
    constexpr std::size_t kCoarse = 5000;
    const mat3 toStandard = glm::mat3_cast(standardFromModel);
    std::size_t vertices = 0;
    for (const SkinnedMesh& mesh : character.meshes)
        vertices += mesh.positions.size();
    const auto aside = static_cast<int>(plan.bodies.size());
    std::vector<std::vector<int>> owners;
    for (const SkinnedMesh& mesh : character.meshes) {
        owners.push_back(bodiesOfVertices(mesh, plan.bodyOfJoint));
        for (std::size_t vertex = 0; vertex < owners.back().size(); ++vertex) {
            if (hanging[mesh.joints[vertex][0]]) owners.back()[vertex] = aside;
            if (held[mesh.joints[vertex][0]]) owners.back()[vertex] = aside + 1;
        }
    }
    hangPiecesOfHead(plan, character, toStandard, aside, owners);
    plan.bodies.resize(plan.bodies.size() + 2);
    for (std::size_t i = 0; i < owners.size(); ++i) {
        const SkinnedMesh& mesh = character.meshes[i];
        if (vertices < kCoarse && !mesh.indices.empty()) {
            addTrianglePoints(plan, mesh, owners[i], toStandard);
        } else {
            addVertices(plan, mesh, owners[i], toStandard);
        }
    }
    std::vector<SkinPoint> hung = std::move(plan.bodies[static_cast<std::size_t>(aside)].skin);
    plan.bodies.resize(static_cast<std::size_t>(aside));
    return hung;
}

void balanceTrunk(BodyPlan& plan) {
    constexpr float kFewest = 0.1F;
    constexpr float kPelvis = 0.22F;
    const std::vector<int> trunk = trunkBodies(plan);
    std::vector<SkinPoint> skin;
    float least = 1e9F;
    float total = 0.0F;
    for (const int body : trunk) {
        const std::vector<SkinPoint>& own = plan.bodies[body].skin;
        skin.insert(skin.end(), own.begin(), own.end());
        least = std::min(least, areaOf(plan.bodies[body]));
        total += areaOf(plan.bodies[body]);
    }
    if (trunk.size() < 2 || least >= kFewest * total || total <= 0.0F) return;
    const float low = heightOfPair(plan, Role::leftUpperLeg, plan.bodies[0].start.y);
    const float high = heightOfPair(plan, Role::leftUpperArm, plan.bodies[trunk.back()].end.y);
    if (high <= low) return;
    const auto parts = static_cast<float>(trunk.size() - 1);
    for (std::size_t i = 0; i + 1 < trunk.size(); ++i) {
        const float along = kPelvis + (1.0F - kPelvis) * static_cast<float>(i) / parts;
        plan.trunkBounds.push_back(low + along * (high - low));
    }
    for (const int body : trunk)
        plan.bodies[body].skin.clear();
    for (const SkinPoint& point : skin)
        plan.bodies[trunkBodyAt(plan, trunk, point.position.y)].skin.push_back(point);
}

}  // namespace lutka::physics
