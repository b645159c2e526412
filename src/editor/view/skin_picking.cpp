#include "editor/view/skin_picking.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "animation/skinning.hpp"

namespace lutka::editor {
namespace {

using physics::JointDrive;

// The body that moves a joint.
int bodyThatMoves(const physics::Rig& rig, int joint) {
    for (std::size_t steps = 0; joint >= 0 && steps <= rig.joints.size(); ++steps) {
        const physics::Rig::Joint& way = rig.joints[static_cast<std::size_t>(joint)];
        if (way.drive == JointDrive::mapped) return way.body;
        if (way.drive == JointDrive::chain) return way.share < 0.5F ? way.upperBody : way.body;
        joint = way.base;
    }
    return 0;
}

struct TriangleHit {
    float distance = 0.0F;
    int corner = 0;  // the one that the place is nearest to
};

// Möller and Trumbore (1997), from both sides.
std::optional<TriangleHit> meet(const render::Ray& ray, const vec3& a, const vec3& b, const vec3& c) {
    const vec3 side1 = b - a;
    const vec3 side2 = c - a;
    const vec3 across = glm::cross(ray.direction, side2);
    const float determinant = glm::dot(side1, across);
    if (determinant == 0.0F) return std::nullopt;
    const vec3 from = ray.origin - a;
    const float u = glm::dot(from, across) / determinant;
    const vec3 up = glm::cross(from, side1);
    const float v = glm::dot(ray.direction, up) / determinant;
    const float distance = glm::dot(side2, up) / determinant;
    if (!(u >= 0.0F && v >= 0.0F && u + v <= 1.0F && distance > 0.0F)) return std::nullopt;
    const float w = 1.0F - u - v;
    return TriangleHit{distance, w >= u && w >= v ? 0 : u >= v ? 1 : 2};
}

// Whether the ray passes the figure, whose bodies stand there: none of its skin is farther from a body than the whole
// figure is large in the bind pose.
bool passes(const render::Ray& ray, std::span<const RigidTransform> bodies, float size) {
    vec3 low = bodies.front().translation;
    vec3 high = low;
    for (const RigidTransform& body : bodies) {
        low = glm::min(low, body.translation);
        high = glm::max(high, body.translation);
    }
    const vec3 middle = 0.5F * (low + high);
    const float radius = 0.5F * glm::distance(low, high) + size;
    const vec3 direction = glm::normalize(ray.direction);
    const float along = std::max(glm::dot(middle - ray.origin, direction), 0.0F);
    return glm::distance(ray.origin + along * direction, middle) <= radius;
}

float sizeOf(const animation::Character& character) {
    vec3 low(0);
    vec3 high(0);
    for (const animation::SkinnedMesh& mesh : character.meshes) {
        for (const vec3& p : mesh.positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    return glm::distance(low, high);
}

class SkinPicker {
  public:
    SkinPicker(const render::Ray& ray, scene::Simulation& simulation, float alpha, float most)
        : ray_(ray), simulation_(simulation), alpha_(alpha), most_(most) {}

    void visit(int doll) {
        const scene::RagdollAsset& asset = simulation_.assetOf(doll);
        const bool drawn = simulation_.showsDoll(doll) && simulation_.scenario().dolls[doll].look.visible;
        if (asset.character.meshes.empty() || !drawn) return;
        if (&asset != sized_) {
            sized_ = &asset;
            size_ = sizeOf(asset.character);
        }
        if (!passes(ray_, simulation_.worldFromBody(doll, alpha_), size_)) return;
        const animation::Skeleton& skeleton = asset.character.skeleton;
        std::vector<RigidTransform> pose(skeleton.parents.size());
        std::vector<animation::SkinMatrix> palette(pose.size());
        simulation_.pose(doll, alpha_, pose);
        animation::skinMatrices(skeleton.bindModelFromJoint, pose, palette);
        for (const animation::SkinnedMesh& mesh : asset.character.meshes)
            visit(doll, asset, mesh, palette);
    }

    [[nodiscard]] const std::optional<SkinHit>& nearest() const { return nearest_; }

  private:
    void visit(int doll, const scene::RagdollAsset& asset, const animation::SkinnedMesh& mesh,
               std::span<const animation::SkinMatrix> palette) {
        positions_.resize(mesh.positions.size());
        animation::skinVertices(mesh, palette, positions_, {});
        const RigidTransform& worldFromModel = simulation_.worldFromModel(doll);
        const RigidTransform modelFromWorld = inverse(worldFromModel);
        const render::Ray ray{modelFromWorld * ray_.origin, modelFromWorld.rotation * ray_.direction};
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const std::uint32_t* corners = &mesh.indices[i];
            const vec3& a = positions_[corners[0]];
            const vec3& b = positions_[corners[1]];
            const vec3& c = positions_[corners[2]];
            const std::optional<TriangleHit> hit = meet(ray, a, b, c);
            if (!hit || hit->distance >= most_) continue;
            most_ = hit->distance;
            const vec3 normal = worldFromModel.rotation * glm::normalize(glm::cross(b - a, c - a));
            const int joint = mesh.joints[corners[hit->corner]][0];
            nearest_ = SkinHit{doll, bodyThatMoves(asset.rig, joint), ray_.origin + hit->distance * ray_.direction,
                               glm::dot(normal, ray_.direction) > 0.0F ? -normal : normal, hit->distance};
        }
    }

    const render::Ray& ray_;
    scene::Simulation& simulation_;
    float alpha_;
    float most_;
    const scene::RagdollAsset* sized_ = nullptr;
    float size_ = 0.0F;
    std::vector<vec3> positions_;
    std::optional<SkinHit> nearest_;
};

}  // namespace

std::optional<SkinHit> pickSkin(const render::Ray& ray, scene::Simulation& simulation, float alpha, float most) {
    SkinPicker picker(ray, simulation, alpha, most);
    for (int doll = 0; doll < simulation.dollCount(); ++doll)
        picker.visit(doll);
    return picker.nearest();
}

}  // namespace lutka::editor
