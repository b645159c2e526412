#include "editor/view/skin_picking.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "animation/skinning.hpp"
#include "core/aabb.hpp"
#include "physics/collision/triangle_mesh.hpp"

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

// Which corner of a triangle a place in it is nearest to.
int cornerNearest(const physics::LineCrossing& place) {
    const float a = 1.0F - place.b - place.c;
    if (a >= place.b && a >= place.c) return 0;
    return place.b >= place.c ? 1 : 2;
}

// Whether the ray passes by the figure, whose bodies stand there: none of its skin is farther from a body than the
// whole figure is large in the bind pose.
bool passesBy(const render::Ray& ray, std::span<const RigidTransform> bodies, float sizeM) {
    Aabb box;
    for (const RigidTransform& body : bodies)
        box.add(body.translation);
    const float radius = 0.5F * box.diagonal() + sizeM;
    const vec3 direction = glm::normalize(ray.direction);
    const float along = std::max(glm::dot(box.middle() - ray.origin, direction), 0.0F);
    return glm::distance(ray.origin + along * direction, box.middle()) > radius;
}

class SkinPicker {
  public:
    SkinPicker(const render::Ray& ray, scene::Simulation& simulation, float alpha, float most)
        : ray_(ray), simulation_(simulation), alpha_(alpha), most_(most) {}

    void visit(int doll) {
        const scene::RagdollAsset& asset = simulation_.assetOf(doll);
        const bool drawn = simulation_.showsDoll(doll) && simulation_.scenario().dolls[doll].look.visible;
        if (asset.character.meshes.empty() || !drawn) return;
        if (passesBy(ray_, simulation_.worldFromBody(doll, alpha_), asset.sizeM)) return;
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
            const auto hit = physics::crossTriangle(a, b, c, ray.origin, ray.direction, physics::Sides::both);
            if (!hit || !(hit->along > 0.0F) || hit->along >= most_) continue;
            most_ = hit->along;
            const vec3 normal = worldFromModel.rotation * glm::normalize(glm::cross(b - a, c - a));
            const int joint = mesh.joints[corners[cornerNearest(*hit)]][0];
            nearest_ = SkinHit{doll, bodyThatMoves(asset.rig, joint), ray_.origin + hit->along * ray_.direction,
                               glm::dot(normal, ray_.direction) > 0.0F ? -normal : normal, hit->along};
        }
    }

    const render::Ray& ray_;
    scene::Simulation& simulation_;
    float alpha_;
    float most_;
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
