#include "editor/editor.hpp"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "core/files.hpp"
#include "scene/scene_file.hpp"

namespace lutka::editor {
namespace {

constexpr float kThrowSpeed = 9.0F;  // m/s

}  // namespace

Result<std::unique_ptr<Editor>> Editor::create(const EditorOptions& options) {
    if (options.sceneFile.empty()) {
        auto document = EditorDocument::open(options.model, options.load);
        if (!document) return document.error();
        return create(std::move(document).value(), options);
    }
    const auto scene = scene::loadScene(options.sceneFile);
    if (!scene) return scene.error();
    EditorOptions all = options;
    for (const scene::Entity& entity : scene.value().entities) {
        const auto* ragdoll = scene.value().find<scene::Ragdoll>(entity.id);
        if (ragdoll == nullptr || ragdoll->model.empty() || !options.model.empty()) continue;
        all.model = ragdoll->model;
        if (!ragdoll->profile.empty()) all.load.profile = ragdoll->profile;
        break;
    }
    if (all.model.empty()) {
        auto own = findAsset("models/mannequin.glb");
        if (!own) return own.error();
        all.model = own.value();
    }
    all.scene.entities = scene.value();
    all.scene.scenario.clear();
    auto document = EditorDocument::open(all.model, all.load);
    if (!document) return document.error();
    auto editor = create(std::move(document).value(), all);
    if (editor) editor.value()->document().setSceneFile(options.sceneFile);
    return editor;
}

Result<std::unique_ptr<Editor>> Editor::create(std::unique_ptr<EditorDocument> document, const EditorOptions& options) {
    std::unique_ptr<Editor> editor(new Editor);
    editor->workspace_.window = options.window;
    editor->load_ = options.load;
    editor->clock_ = options.clock;
    SceneSettings scene = options.scene;
    if (options.applyToWorld) options.applyToWorld(scene.entities.simulation.world);
    if (auto started = document->startScene(scene); !started) return started.error();
    auto player = std::make_unique<Player>(*document, options.clock);
    if (auto built = player->rebuild(Player::Keep::nothing); !built) return built.error();
    editor->workspace_.document = std::move(document);
    editor->workspace_.player = std::move(player);
    editor->player().setPlaying(options.playing);
    editor->player().setSparing(options.spareSubsteps);
    editor->view.layers.capsules = true;
    editor->view.layers.limits = true;
    editor->workspace_.camera = startCamera(editor->player().simulation(), options.window);
    editor->machine_ = std::make_unique<StateMachine>(makeHandlers(editor->workspace_));
    editor->greet(!options.load.profile.has_value());
    return editor;
}

Editor::~Editor() = default;

bool Editor::busy() const {
    const State now = state();
    return now != State::idle && now != State::selected;
}

void Editor::handle(const InputEvent& event, const UiCapture& capture) {
    const bool dragging = std::find(held_.begin(), held_.end(), true) != held_.end();
    switch (event.kind) {
        case InputEvent::Kind::mouseMove: {
            const vec2 movement = event.position - workspace_.mouse;
            workspace_.mouse = event.position;
            if (!capture.mouse || dragging) machine_->mouseMove(event.position, movement);
            break;
        }
        case InputEvent::Kind::mouseButton:
            handleMouseButton(event, capture);
            break;
        case InputEvent::Kind::wheel:
            if (!capture.mouse) machine_->wheel(event.wheel);
            break;
        case InputEvent::Kind::key:
            handleKey(event, capture);
            break;
        case InputEvent::Kind::text:
            // By what is typed, not by the key: "?" lies elsewhere on every keyboard.
            if (event.codepoint == '?' && !capture.keyboard && !busy()) perform(Action::toggleHelp);
            break;
        case InputEvent::Kind::drop:
            if (!event.files.empty()) open(event.files.front());
            break;
        case InputEvent::Kind::resize:
            workspace_.window = event.size;
            break;
        case InputEvent::Kind::focus:
            if (event.pressed) break;
            held_ = {};
            workspace_.press.reset();
            endTransform();
            break;
        case InputEvent::Kind::close:
            perform(Action::quit);
            break;
    }
}

void Editor::handleMouseButton(const InputEvent& event, const UiCapture& capture) {
    bool& held = held_[static_cast<std::size_t>(event.button)];
    if (event.pressed && (capture.mouse || asking())) return;
    if (!event.pressed && !held) return;  // it went down on a panel
    held = event.pressed;
    if (event.pressed) endSwing();
    machine_->mouseButton(event);
}

void Editor::handleKey(const InputEvent& event, const UiCapture& capture) {
    if (capture.keyboard || asking()) return;
    if (view.help && event.pressed && event.key == Key::escape) {
        view.help = false;
        return;
    }
    if (swing_ && event.pressed && event.key == Key::escape) {
        endSwing();
        return;
    }
    const auto action = actionFor(event);
    // While something is under way letters and digits are its own, but time and debug draw are everybody's.
    const bool always = action == Action::togglePlay || action == Action::toggleDebug;
    if (action && (always || !busy())) {
        if (!event.repeated || action == Action::stepOnce || action == Action::undo) perform(*action);
        return;
    }
    machine_->key(event);
}

void Editor::perform(Action action) {
    const bool looksOnly = action >= Action::focus;
    if (!looksOnly) endSwing();
    if (performOnDocument(action) || performOnParts(action) || performOnSimulation(action)) return;
    switch (action) {
        case Action::selectNone:
            select(std::nullopt);
            break;
        case Action::focus:
            focus();
            break;
        case Action::followDoll:
            toggleFollow();
            break;
        case Action::viewFront:
            axisView(0.0F, 0.0F);
            break;
        case Action::viewRight:
            axisView(kPi / 2.0F, 0.0F);
            break;
        case Action::viewTop:
            axisView(0.0F, kPi / 2.0F);
            break;
        case Action::toggleDebug:
            view.debug = !view.debug;
            break;
        case Action::togglePanels:
            view.panels = !view.panels;
            break;
        case Action::toggleHandles:
            workspace_.showHandles = !workspace_.showHandles;
            workspace_.hotHandle.reset();
            break;
        case Action::toggleHelp:
            view.help = !view.help;
            break;
        default:
            LUTKA_ASSERT(false);  // the two above have done it
            break;
    }
}

bool Editor::performOnDocument(Action action) {
    switch (action) {
        case Action::openModel:
            dialog = Dialog::openModel;
            return true;
        case Action::saveProfile:
            saveAll();
            return true;
        case Action::saveScene:
            requestSaveScene(document().sceneFile());
            return true;
        case Action::saveSceneAs:
            dialog = Dialog::saveSceneAs;
            return true;
        case Action::saveProfileAs:
            dialog = Dialog::saveAs;
            return true;
        case Action::exportBaked:
            dialog = Dialog::exportBaked;
            return true;
        case Action::quit:
            afterUnsaved([this] { quitting_ = true; });
            return true;
        case Action::undo:
        case Action::redo:
            travel(action == Action::undo ? -1 : 1);
            return true;
        default:
            return false;
    }
}

bool Editor::performOnParts(Action action) {
    const std::vector<int> bodies = workspace_.selectedBodies();
    switch (action) {
        case Action::copyPart:
            if (bodies.empty()) return true;
            workspace_.clipboard = document().copyPart(bodies.back());
            workspace_.say(
                Toast::Kind::info,
                fmt::format("Copied {}", animation::roleName(document().profile().bodies[bodies.back()].role)));
            return true;
        case Action::pastePart:
            if (workspace_.clipboard && !bodies.empty()) {
                edit([&](EditorDocument& one) { return one.pasteParts(bodies, *workspace_.clipboard); });
            }
            return true;
        case Action::mirrorParts:
            if (!bodies.empty()) edit([&](EditorDocument& one) { return one.mirrorParts(bodies); });
            return true;
        case Action::swingLimits:
            swingLimits();
            return true;
        default:
            return false;
    }
}

bool Editor::performOnSimulation(Action action) {
    Player& player = *workspace_.player;
    switch (action) {
        case Action::pin:
            togglePin();
            return true;
        case Action::unpinAll:
            workspace_.pulls.pins.clear();
            return true;
        case Action::togglePlay:
            player.setPlaying(!player.playing());
            return true;
        case Action::stepOnce:
            workspace_.pulls.applyTo(player.simulation());
            player.stepOnce();
            return true;
        case Action::reset:
            endTransform();
            workspace_.pulls.pins.clear();
            workspace_.report(player.reset());
            return true;
        case Action::returnToPlay:
            endTransform();
            player.returnToPlay();
            workspace_.pulls.applyTo(player.simulation());
            return true;
        case Action::throwBall:
            throwBall();
            return true;
        default:
            return false;
    }
}

void Editor::update(double seconds) {
    workspace_.overlay.clear();
    workspace_.frameSeconds = static_cast<float>(seconds);
    machine_->update();
    workspace_.follow();
    workspace_.pulls.applyTo(workspace_.player->simulation());
    if (swing_) {
        swing_->advance(static_cast<float>(seconds));
        player().preview(swingDoll_, swing_->worldFromBody());
        workspace_.hint = "Within its limits: " + swing_->text() + "   Esc: stop";
        if (swing_->done()) endSwing();
    } else {
        player().advance(seconds);
    }
    followDoll();
    for (Toast& toast : workspace_.toasts)
        toast.secondsLeft -= static_cast<float>(seconds);
    std::erase_if(workspace_.toasts, [](const Toast& toast) { return toast.secondsLeft <= 0.0F; });
}

void Editor::swingLimits() {
    endTransform();
    endSwing();
    const auto active = workspace_.selection.active();
    if (!active || active->kind != Item::Kind::body || active->index == 0) return;
    std::vector<RigidTransform> bodies;
    for (const physics::BodyState& body : player().bodiesOf(active->doll))
        bodies.push_back(body.worldFromBody);
    swing_.emplace(document().profile(), active->index, std::move(bodies));
    swingDoll_ = active->doll;
}

void Editor::endSwing() {
    if (!swing_) return;
    swing_.reset();
    player().endPreview();
}

void Editor::beginPickJoint(animation::Role role) {
    endTransform();
    endSwing();
    workspace_.pickRole = role;
    machine_->fire(Trigger::pickJointAsked);
}

void Editor::endPickJoint(bool take) {
    if (state() != State::pickJoint) return;
    if (take) machine_->mouseButton(mouseButton(MouseButton::left, false));
    endTransform();
}

bool Editor::edit(const std::function<Result<void>(EditorDocument&)>& change) {
    endTransform();
    endSwing();
    const bool failed = workspace_.report(change(document()));
    workspace_.follow();
    machine_->fire(workspace_.ended());
    return !failed;
}

void Editor::travel(int changes) {
    endTransform();
    endSwing();
    for (; changes < 0; ++changes)
        document().undo();
    for (; changes > 0; --changes)
        document().redo();
    workspace_.follow();
    machine_->fire(workspace_.ended());
}

void Editor::endTransform() {
    if (busy()) machine_->fire(workspace_.ended());
}

void Editor::select(std::optional<Item> item, bool add) {
    endTransform();
    endSwing();
    if (!item) {
        workspace_.selection.clear();
    } else if (add) {
        workspace_.selection.toggle(*item);
    } else {
        workspace_.selection.set(*item);
    }
    machine_->fire(workspace_.selection.empty() ? Trigger::pickedNothing : Trigger::picked);
}

void Editor::beginAdd(scene::EntityKind kind) {
    endTransform();
    workspace_.addKind = kind;
    machine_->fire(Trigger::addKey);
}

void Editor::togglePin() {
    const auto active = workspace_.selection.active();
    if (!active) return;
    if (active->kind == Item::Kind::object) {
        // A character of another model is pinned while it is dragged; here all its pins are let go.
        const int doll = player().dollOf(static_cast<scene::EntityId>(active->index));
        if (doll >= 0) std::erase_if(workspace_.pulls.pins, [&](const Pull& pin) { return pin.doll == doll; });
        return;
    }
    const animation::Role role = document().profile().bodies[active->index].role;
    auto& pins = workspace_.pulls.pins;
    if (const auto pin = workspace_.pulls.findPin(active->doll, role); pin != pins.end()) {
        pins.erase(pin);
        return;
    }
    pins.push_back({active->doll, role, vec3(0), workspace_.positionOf(*active)});
}

void Editor::throwBall() {
    const render::Ray ray = workspace_.mouseRay();
    const vec3 from = ray.origin + ray.direction * std::min(0.5F, workspace_.camera.distance * 0.2F);
    // Lifted a little, so that it meets what the mouse points at in spite of gravity.
    if (workspace_.report(player().throwBall(from, ray.direction * kThrowSpeed + vec3(0, 0.8F, 0)))) return;
    workspace_.pulls.applyTo(player().simulation());
}

void Editor::focus() {
    render::Camera& camera = workspace_.camera;
    const float aspect = workspace_.window.aspect();
    if (const auto active = workspace_.selection.active()) {
        constexpr float bodyRadius = 0.45F;
        render::frameSphere(camera, workspace_.positionOf(*active), bodyRadius, aspect);
        return;
    }
    if (player().simulation().dollCount() == 0) return;
    const auto bodies = player().bodiesOf(0);
    vec3 low = bodies.front().worldFromBody.translation;
    vec3 high = low;
    for (const physics::BodyState& body : bodies) {
        low = glm::min(low, body.worldFromBody.translation);
        high = glm::max(high, body.worldFromBody.translation);
    }
    constexpr float around = 0.25F;  // metres of flesh beyond the outermost centres
    render::frameSphere(camera, (low + high) * 0.5F, glm::distance(low, high) * 0.5F + around, aspect);
}

void Editor::toggleFollow() {
    if (workspace_.followed) {
        workspace_.followed.reset();
        return;
    }
    const auto active = workspace_.selection.active();
    workspace_.followed = active && active->kind == Item::Kind::body ? active->doll : 0;
    followedAt_ = player().simulation().worldFromBody(*workspace_.followed, player().alpha())[0].translation;
    workspace_.say(Toast::Kind::info, "The camera follows the doll; Shift+F lets it go");
}

// Target and eye go along with the hips, so that orbiting and zooming stay the user's.
void Editor::followDoll() {
    if (!workspace_.followed) return;
    if (*workspace_.followed >= player().simulation().dollCount()) {
        workspace_.followed.reset();
        return;
    }
    const vec3 now = player().simulation().worldFromBody(*workspace_.followed, player().alpha())[0].translation;
    workspace_.camera.target += now - followedAt_;
    followedAt_ = now;
}

void Editor::axisView(float yaw, float pitch) {
    workspace_.camera.yaw = yaw;
    workspace_.camera.pitch = pitch;
    render::orbit(workspace_.camera, 0.0F, 0.0F);  // keeps off the pole
}

}  // namespace lutka::editor
