#include "editor/view/view_camera.hpp"

#include <glm/geometric.hpp>

#include "scene/draw_simulation.hpp"

namespace lutka::editor {

void ViewCamera::frameScene() {
    constexpr float room = 1.15F;
    const scene::Scenario& scenario = workspace_.player->simulation().scenario();
    workspace_.camera = scene::cameraFor(scenario, workspace_.window.aspect());
    if (!scenario.camera) render::dolly(workspace_.camera, room);
}

void ViewCamera::focus() {
    const Player& player = *workspace_.player;
    const float aspect = workspace_.window.aspect();
    if (const auto active = workspace_.selection.active()) {
        constexpr float bodyRadius = 0.45F;
        render::frameSphere(workspace_.camera, workspace_.positionOf(*active), bodyRadius, aspect);
        return;
    }
    if (player.simulation().dollCount() == 0) return;
    const auto bodies = player.bodiesOf(0);
    vec3 low = bodies.front().worldFromBody.translation;
    vec3 high = low;
    for (const physics::BodyState& body : bodies) {
        low = glm::min(low, body.worldFromBody.translation);
        high = glm::max(high, body.worldFromBody.translation);
    }
    constexpr float around = 0.25F;  // metres of flesh beyond the outermost centres
    const float radius = glm::distance(low, high) * 0.5F + around;
    render::frameSphere(workspace_.camera, (low + high) * 0.5F, radius, aspect);
}

void ViewCamera::lookAlong(float yaw, float pitch) {
    workspace_.camera.yaw = yaw;
    workspace_.camera.pitch = pitch;
    render::orbit(workspace_.camera, 0.0F, 0.0F);  // keeps off the pole
}

void ViewCamera::toggleFollow() {
    if (workspace_.followed) {
        workspace_.followed.reset();
        return;
    }
    Player& player = *workspace_.player;
    const auto active = workspace_.selection.active();
    workspace_.followed = active && active->kind == Item::Kind::body ? active->doll : 0;
    followedAt_ = player.simulation().worldFromBody(*workspace_.followed, player.alpha())[0].translation;
    workspace_.say(Toast::Kind::info, "The camera follows the doll; Shift+F lets it go");
}

void ViewCamera::follow() {
    if (!workspace_.followed) return;
    Player& player = *workspace_.player;
    if (*workspace_.followed >= player.simulation().dollCount()) {
        workspace_.followed.reset();
        return;
    }
    const vec3 now = player.simulation().worldFromBody(*workspace_.followed, player.alpha())[0].translation;
    workspace_.camera.target += now - followedAt_;
    followedAt_ = now;
}

void ViewCamera::lookThrough(scene::EntityId id) {
    const scene::EntityScene& scene = workspace_.document->scene();
    const auto* camera = scene.find<scene::Camera>(id);
    if (camera != nullptr) workspace_.camera = scene::viewOf(*camera, scene::worldFromEntity(scene, id));
}

}  // namespace lutka::editor
