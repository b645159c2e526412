#include "editor/states/workspace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "editor/editor_words.hpp"
#include "editor/view/pick_targets.hpp"
#include "editor/view/skin_picking.hpp"

namespace lutka::editor {
namespace {

// What of a skin has no shape of a body (fingers, hair, a skirt) is picked as the body that carries it.
std::optional<Pick> pickOfSkin(const render::Ray& ray, Player& player, float most) {
    const std::optional<SkinHit> hit = pickSkin(ray, player.simulation(), player.alpha(), most);
    if (!hit) return std::nullopt;
    const Item body{Item::Kind::body, hit->doll, hit->body};
    return Pick{body, hit->position, hit->normal, body};
}

}  // namespace

std::optional<Pick> Workspace::pickUnderMouse() const {
    return underMouse(true);
}

std::optional<Pick> Workspace::shapeUnderMouse() const {
    return underMouse(false);
}

std::optional<Pick> Workspace::underMouse(bool skin) const {
    // Walls that are drawn see-through do not hide what fell between them.
    const auto& looks = player->simulation().scenario().staticLooks;
    constexpr int solid = 128;
    const bool seeThrough =
        std::any_of(looks.begin(), looks.end(), [](const scene::Look& look) { return look.color.a < solid; });
    const render::Ray ray = mouseRay();
    const std::vector<PickTarget> targets = pickTargets(*document, *player);
    const PickedRay met = pickAlong(ray, player->simulation(), targets, seeThrough);
    std::optional<Pick> picked = met.pick;
    if (skin && skinShown && !met.marker && (!picked || !picked->body)) {
        if (const auto ofSkin = pickOfSkin(ray, *player, met.distance)) picked = ofSkin;
    }
    // The panels edit no bodies of the other characters: these are picked as a whole, and pulled by their bodies.
    if (picked && picked->item.kind == Item::Kind::body && !player->isEditedDoll(picked->item.doll)) {
        picked->item = {Item::Kind::object, 0, static_cast<int>(player->entityOfDoll(picked->item.doll))};
    }
    return picked;
}

std::optional<HandleScene> Workspace::handleScene() const {
    const auto active = selection.active();
    if (!active || active->kind != Item::Kind::body || player->stale()) return std::nullopt;
    const auto bodies = player->simulation().worldFromBody(active->doll, player->alpha());
    HandleScene scene{document->profile(), active->index, bodies[active->index], {}, {}};
    if (const physics::ConstraintProfile* constraint = scene.constraint()) {
        const auto& bind = document->asset().rig.bindModelFromBody;
        scene.worldFromParent = bodies[constraint->parent];
        scene.bind = {bind[constraint->parent], bind[constraint->child]};
    }
    return scene;
}

std::optional<Handle> Workspace::handleUnderMouse() const {
    if (!showHandles) return std::nullopt;
    const auto scene = handleScene();
    if (!scene) return std::nullopt;
    constexpr float reach = 11.0F;
    return handleUnder(handlesOf(*scene, camera), camera, mouse, window, reach * uiScale);
}

std::optional<Gizmo> Workspace::gizmo() const {
    const auto active = selection.active();
    if (!active || player->stale() || tool == Tool::hit) return std::nullopt;
    const bool body = active->kind == Item::Kind::body;
    if (body && tool == Tool::select) return std::nullopt;  // a drag pulls it, and its limits have handles
    const Tool shown = tool == Tool::select ? Tool::move : tool;
    RigidTransform frame = frameOf(*active);
    const bool own = localAxes || shown == Tool::scale;
    if (!own) frame.rotation = quat(1, 0, 0, 0);
    constexpr float arm = 84.0F;
    return gizmoAt(shown, frame, own, camera, window, arm * uiScale);
}

std::optional<AxisLock> Workspace::gizmoUnderMouse() const {
    constexpr float reach = 9.0F;
    const auto shown = gizmo();
    return shown ? gizmoPartUnder(*shown, camera, mouse, window, reach * uiScale) : std::nullopt;
}

void Workspace::zoom(float notches) {
    constexpr float perNotch = 0.89F;  // of the distance is left
    const render::Ray ray = mouseRay();
    const float facing = glm::dot(ray.direction, render::forwardOf(camera));
    const float before = camera.distance;
    const float along = glm::dot(camera.target - ray.origin, render::forwardOf(camera)) / std::max(facing, 0.1F);
    render::dolly(camera, std::pow(perNotch, notches));
    const vec3 held = ray.origin + ray.direction * along;
    camera.target = held + (camera.target - held) * (camera.distance / before);
}

std::vector<vec3> Workspace::worldOfJoints(int doll) const {
    scene::Simulation& simulation = player->simulation();
    std::vector<RigidTransform> pose(simulation.assetOf(doll).character.skeleton.parents.size());
    simulation.pose(doll, player->alpha(), pose);
    std::vector<vec3> places;
    places.reserve(pose.size());
    for (const RigidTransform& joint : pose)
        places.push_back(simulation.worldFromModel(doll) * joint.translation);
    return places;
}

std::vector<int> Workspace::selectedBodies() const {
    std::vector<int> bodies;
    for (const Item& item : selection.items()) {
        if (item.kind != Item::Kind::body) continue;
        std::erase(bodies, item.index);
        bodies.push_back(item.index);
    }
    return bodies;
}

bool Workspace::edit(const std::function<Result<void>(EditorDocument&)>& change) {
    const bool failed = report(change(*document));
    follow();
    return !failed;
}

vec3 Workspace::positionOf(const Item& item) const {
    if (item.kind == Item::Kind::object) {
        return player->worldFromEntity(static_cast<scene::EntityId>(item.index)).translation;
    }
    return player->bodiesOf(item.doll)[static_cast<std::size_t>(item.index)].worldFromBody.translation;
}

RigidTransform Workspace::frameOf(const Item& item) const {
    if (item.kind == Item::Kind::object) return player->worldFromEntity(static_cast<scene::EntityId>(item.index));
    return player->bodiesOf(item.doll)[static_cast<std::size_t>(item.index)].worldFromBody;
}

std::string Workspace::nameOf(const Item& item) const {
    if (item.kind == Item::Kind::object) {
        const scene::Entity* entity = scene::findEntity(document->scene(), static_cast<scene::EntityId>(item.index));
        return entity != nullptr ? entity->name : "";
    }
    const physics::RagdollProfile& profile =
        player->isEditedDoll(item.doll) ? document->profile() : player->simulation().assetOf(item.doll).profile;
    const physics::BodyProfile& body = profile.bodies[item.index];
    const std::string doll = player->simulation().dollCount() > 1 ? fmt::format(" of doll {}", item.doll + 1) : "";
    const std::string& name = body.name;
    return fmt::format("{}{}{}", name, doll, body.joint == name ? "" : " (" + body.joint + ")");
}

void Workspace::follow() {
    if (!player->stale()) return;
    followBodies();
    report(player->rebuild(Player::Keep::motion));
    pulls.applyTo(player->simulation());
    const physics::RagdollProfile& profile = document->profile();
    selection.keepIf([&](const Item& item) {
        if (item.kind == Item::Kind::object) {
            return scene::findEntity(document->scene(), static_cast<scene::EntityId>(item.index)) != nullptr;
        }
        return item.doll < player->simulation().dollCount() && player->isEditedDoll(item.doll) &&
               item.index < static_cast<int>(profile.bodies.size());
    });
}

void Workspace::rememberBodies() {
    bodyNames_.clear();
    for (const physics::BodyProfile& body : document->profile().bodies)
        bodyNames_.push_back(body.name);
}

void Workspace::followBodies() {
    const physics::RagdollProfile& profile = document->profile();
    const std::vector<std::string> before = bodyNames_;
    rememberBodies();
    if (before == bodyNames_) return;
    const std::vector<Item> items = selection.items();
    selection.clear();
    for (Item item : items) {
        if (item.kind == Item::Kind::body) {
            item.index = item.index < static_cast<int>(before.size())
                             ? physics::bodyNamed(profile, before[static_cast<std::size_t>(item.index)])
                             : -1;
            if (item.index < 0) continue;
        }
        selection.toggle(item);
    }
}

void Workspace::pose(bool on) {
    report(player->setPosing(on));
    pulls.applyTo(player->simulation());
}

std::shared_ptr<const PlayState> Workspace::playState() const {
    constexpr int mostDolls = 200;
    if (player->simulation().dollCount() > mostDolls) return nullptr;
    auto state = std::make_shared<PlayState>(player->state());
    state->pins = pulls.pins;
    return state;
}

void Workspace::restore(const PlayState& state, bool motion) {
    if (motion) report(player->restore(state));
    pulls.pins = state.pins;
    pulls.applyTo(player->simulation());
}

bool Workspace::report(const Result<void>& result) {
    if (result) return false;
    say(Toast::Kind::error, result.error().text());
    return true;
}

void Workspace::note(Toast::Kind kind, std::string text) {
    constexpr std::size_t maxLog = 500;
    log.push_back({kind, inEditorWords(std::move(text))});
    if (log.size() > maxLog) log.erase(log.begin());
}

void Workspace::say(Toast::Kind kind, std::string text) {
    constexpr std::size_t maxToasts = 4;
    text = inEditorWords(std::move(text));
    note(kind, text);
    const bool shown = std::any_of(toasts.begin(), toasts.end(), [&](Toast& toast) { return toast.text == text; });
    if (shown) return;
    if (toasts.size() >= maxToasts) toasts.erase(toasts.begin());
    toasts.push_back({kind, std::move(text), kind == Toast::Kind::error ? 8.0F : 4.0F});
}

}  // namespace lutka::editor
