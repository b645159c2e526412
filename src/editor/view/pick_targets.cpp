#include "editor/view/pick_targets.hpp"

namespace lutka::editor {

std::vector<PickTarget> pickTargets(const EditorDocument& document, const Player& player) {
    std::vector<PickTarget> targets;
    const scene::EntityScene& scene = document.scene();
    const auto add = [&](scene::EntityId id, const RigidTransform& world, const vec3& half, bool marker) {
        targets.push_back({static_cast<int>(id), world, half, marker});
    };
    for (const scene::Collider& collider : scene.all<scene::Collider>()) {
        const auto* mesh = scene.find<scene::MeshRenderer>(collider.entity);
        // What is see-through must not hide what is behind it.
        if (mesh == nullptr || !mesh->visible || mesh->opacity < 0.5F) continue;
        const RigidTransform world = player.worldFromEntity(collider.entity);
        const std::vector<scene::ColliderBox> boxes = scene::boxesOf(collider);
        for (const scene::ColliderBox& box : boxes)
            add(collider.entity, world * box.entityFromBox, box.halfExtents, false);
        const auto box = scene::boxOf(scene, collider.entity);
        if (boxes.empty() && box) add(collider.entity, world, box->half, false);
    }
    const auto addMarker = [&](scene::EntityId id) {
        if (scene.find<scene::Collider>(id) != nullptr) return;
        if (const auto box = scene::boxOf(scene, id)) add(id, player.worldFromEntity(id), box->half, true);
    };
    for (const scene::Light& light : scene.all<scene::Light>())
        addMarker(light.entity);
    for (const scene::Camera& camera : scene.all<scene::Camera>())
        addMarker(camera.entity);
    return targets;
}

}  // namespace lutka::editor
