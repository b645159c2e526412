#include "editor/view/view_camera.hpp"

#include <glm/geometric.hpp>

#include "scene/draw/draw_simulation.hpp"
#include "scene/draw/scene_extent.hpp"

namespace lutka::editor {

namespace {

// Room around what is framed, as a share of the free part of the picture on each side.
constexpr float kRoom = 0.05F;

render::PictureInsets withRoom(const render::PictureInsets& covered) {
    const float across = (1.0F - covered.left - covered.right) * kRoom;
    const float up = (1.0F - covered.top - covered.bottom) * kRoom;
    return {covered.left + across, covered.right + across, covered.top + up, covered.bottom + up};
}

bool sameInsets(const render::PictureInsets& a, const render::PictureInsets& b) {
    return a.left == b.left && a.right == b.right && a.top == b.top && a.bottom == b.bottom;
}

bool sameView(const render::Camera& a, const render::Camera& b) {
    return a.target == b.target && a.distance == b.distance && a.yaw == b.yaw && a.pitch == b.pitch &&
           a.fieldOfView == b.fieldOfView && a.orthographic == b.orthographic;
}

}  // namespace

std::vector<vec3> ViewCamera::pointsOfAll() const {
    std::vector<vec3> points;
    scene::addExtentOfScene(workspace_.player->simulation(), 1.0F, points);
    return points;
}

void ViewCamera::frame(std::vector<vec3> points) {
    if (points.empty()) return;
    framed_ = Framed{std::move(points), workspace_.camera, {}, {}};
    frameAgain();
}

void ViewCamera::frameAgain() {
    framed_->window = workspace_.window;
    framed_->covered = workspace_.covered;
    render::framePoints(workspace_.camera, framed_->points, workspace_.window.aspect(), withRoom(workspace_.covered));
    framed_->camera = workspace_.camera;
}

void ViewCamera::frameScene() {
    const scene::Scenario& scenario = workspace_.player->simulation().scenario();
    workspace_.camera = scene::cameraFor(scenario, workspace_.window.aspect());
    framed_.reset();
    if (!scenario.camera) frame(pointsOfAll());
    workspace_.followed.reset();
    const auto& puppets = workspace_.document->scene().simulation.puppets;
    const bool walks = puppets && !puppets->clip.empty() && scenario.dolls.size() == 1;
    if (walks && scenario.focusFollows && !scenario.camera) toggleFollow();
}

void ViewCamera::focus() {
    const auto active = workspace_.selection.active();
    if (!active) return frame(pointsOfAll());
    // Of a person's body with what hangs on it, in proportion for dragons and toys.
    constexpr float kAroundObject = 0.45F;  // metres
    constexpr float kAroundBody = 0.255F;   // of the figure's height
    const bool isBody = active->kind == Item::Kind::body;
    const float around =
        isBody ? kAroundBody * workspace_.player->simulation().assetOf(active->doll).profile.heightM : kAroundObject;
    const vec3 centre = workspace_.positionOf(*active);
    const vec3 up = render::upOf(workspace_.camera) * around;
    const vec3 right = render::rightOf(workspace_.camera) * around;
    frame({centre + up, centre - up, centre + right, centre - right});
}

void ViewCamera::lookAlong(float yaw, float pitch) {
    workspace_.camera.yaw = yaw;
    workspace_.camera.pitch = pitch;
    render::orbit(workspace_.camera, 0.0F, 0.0F);  // keeps off the pole
}

bool ViewCamera::seesFreely(const vec3& point) const {
    const auto seen = render::project(workspace_.camera, point, workspace_.window);
    if (!seen) return false;
    const render::PictureInsets& covered = workspace_.covered;
    const float x = seen->x / static_cast<float>(workspace_.window.width);
    const float y = seen->y / static_cast<float>(workspace_.window.height);
    return x > covered.left && x < 1.0F - covered.right && y > covered.top && y < 1.0F - covered.bottom;
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
    // Who has fallen out of the picture comes into its middle; else the view stays as the user has it.
    if (!seesFreely(followedAt_)) workspace_.camera.target = followedAt_;
    workspace_.say(Toast::Kind::info, "The camera follows the doll; Shift+F lets it go");
}

void ViewCamera::follow() {
    if (framed_ && !sameView(framed_->camera, workspace_.camera)) framed_.reset();
    const bool covered = framed_ && !sameInsets(framed_->covered, workspace_.covered);
    if (framed_ && (covered || framed_->window.width != workspace_.window.width ||
                    framed_->window.height != workspace_.window.height)) {
        frameAgain();
    }
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
