#include "editor/editor.hpp"

#include <fmt/format.h>

#include <array>
#include <glm/geometric.hpp>

#include "core/files.hpp"
#include "editor/document/open_document.hpp"
#include "editor/view/select_bodies.hpp"
#include "scene/scene_file.hpp"

namespace lutka::editor {
namespace {

constexpr float kThrowSpeed = 9.0F;  // m/s

bool isProfile(const std::filesystem::path& file) {
    return file.extension() == ".json";
}

// The options with the scene's file read: its first character is the model, unless another was asked for.
Result<EditorOptions> withSceneRead(const EditorOptions& options) {
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
    return all;
}

}  // namespace

Result<std::unique_ptr<Editor>> Editor::create(const EditorOptions& options) {
    const bool fromScene = !options.sceneFile.empty();
    const auto all = fromScene ? withSceneRead(options) : Result<EditorOptions>(options);
    if (!all) return all.error();
    auto document = EditorDocument::open(all.value().model, all.value().load);
    if (!document) return document.error();
    auto editor = create(std::move(document).value(), all.value());
    if (editor && fromScene) editor.value()->document().sceneDocument().setFile(options.sceneFile);
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
    editor->camera_.frameScene();
    editor->machine_ = std::make_unique<StateMachine>(makeHandlers(editor->workspace_));
    editor->files_.greet(!options.load.profile.has_value());
    editor->listenToDocument();
    if (options.recovery.empty()) return editor;
    if (const auto begun = editor->recovery_.begin(options.recovery); !begun)
        editor->workspace_.say(Toast::Kind::warning, begun.error().text());
    return editor;
}

Editor::Editor() : files_(workspace_, [this] { endTransform(); }) {}

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
    if (event.pressed && (capture.mouse || files_.asking())) return;
    if (!event.pressed && !held) return;  // it went down on a panel
    held = event.pressed;
    if (event.pressed) endSwing();
    machine_->mouseButton(event);
}

void Editor::handleKey(const InputEvent& event, const UiCapture& capture) {
    if (capture.keyboard || files_.asking()) return;
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

// In the order of Action.
std::span<const Editor::Command> Editor::commands() {
    static constexpr std::array kCommands{
        Command{Action::openModel, true, [](Editor& e) { e.dialog = Dialog::openModel; }},
        Command{Action::saveProfile, true, [](Editor& e) { e.files_.saveAll(); }},
        Command{Action::saveProfileAs, true, [](Editor& e) { e.dialog = Dialog::saveAs; }},
        Command{Action::saveScene, true,
                [](Editor& e) { e.files_.requestSaveScene(e.document().sceneDocument().file()); }},
        Command{Action::saveSceneAs, true, [](Editor& e) { e.dialog = Dialog::saveSceneAs; }},
        Command{Action::exportBaked, true, [](Editor& e) { e.dialog = Dialog::exportBaked; }},
        Command{Action::quit, true, [](Editor& e) { e.quit(); }},
        Command{Action::undo, true, [](Editor& e) { e.travel(-1); }},
        Command{Action::redo, true, [](Editor& e) { e.travel(1); }},
        Command{Action::selectNone, true, [](Editor& e) { e.select(std::nullopt); }},
        Command{Action::copyPart, true, [](Editor& e) { e.copyPart(); }},
        Command{Action::pastePart, true, [](Editor& e) { e.pastePart(); }},
        Command{Action::mirrorParts, true, [](Editor& e) { e.mirrorParts(); }},
        Command{Action::swingLimits, true, [](Editor& e) { e.swingLimits(); }},
        Command{Action::pin, true, [](Editor& e) { e.togglePin(); }},
        Command{Action::unpinAll, true, [](Editor& e) { e.unpinAll(); }},
        Command{Action::togglePlay, true, [](Editor& e) { e.player().setPlaying(!e.player().playing()); }},
        Command{Action::stepOnce, true, [](Editor& e) { e.stepOnce(); }},
        Command{Action::reset, true, [](Editor& e) { e.reset(); }},
        Command{Action::throwBall, true, [](Editor& e) { e.throwBall(); }},
        Command{Action::returnToPlay, true, [](Editor& e) { e.returnToPlay(); }},
        Command{Action::focus, false, [](Editor& e) { e.camera_.focus(); }},
        Command{Action::followDoll, false, [](Editor& e) { e.camera_.toggleFollow(); }},
        Command{Action::viewFront, false, [](Editor& e) { e.camera_.lookAlong(0.0F, 0.0F); }},
        Command{Action::viewRight, false, [](Editor& e) { e.camera_.lookAlong(kPi / 2.0F, 0.0F); }},
        Command{Action::viewTop, false, [](Editor& e) { e.camera_.lookAlong(0.0F, kPi / 2.0F); }},
        Command{Action::viewBack, false, [](Editor& e) { e.camera_.lookAlong(kPi, 0.0F); }},
        Command{Action::viewLeft, false, [](Editor& e) { e.camera_.lookAlong(-kPi / 2.0F, 0.0F); }},
        Command{Action::viewBottom, false, [](Editor& e) { e.camera_.lookAlong(0.0F, -kPi / 2.0F); }},
        Command{Action::toggleParallel, false,
                [](Editor& e) { e.workspace_.camera.orthographic = !e.workspace_.camera.orthographic; }},
        Command{Action::selectMirror, false,
                [](Editor& e) { selectMirror(e.workspace_.selection, e.document().profile()); }},
        Command{Action::selectChildren, false,
                [](Editor& e) { selectChildren(e.workspace_.selection, e.document().profile()); }},
        Command{Action::toggleDebug, false, [](Editor& e) { e.view.debug = !e.view.debug; }},
        Command{Action::toggleHandles, false, [](Editor& e) { e.toggleHandles(); }},
        Command{Action::togglePanels, false, [](Editor& e) { e.view.panels = !e.view.panels; }},
        Command{Action::toggleHelp, false, [](Editor& e) { e.view.help = !e.view.help; }},
    };
    return kCommands;
}

void Editor::perform(Action action) {
    const Command& command = commands()[static_cast<std::size_t>(action)];
    LUTKA_ASSERT(command.action == action);
    if (command.endsSwing) endSwing();
    command.run(*this);
}

void Editor::copyPart() {
    const std::vector<int> bodies = workspace_.selectedBodies();
    if (bodies.empty()) return;
    workspace_.clipboard = document().copyPart(bodies.back());
    workspace_.say(Toast::Kind::info, fmt::format("Copied {}", document().profile().bodies[bodies.back()].name));
}

void Editor::pastePart() {
    const std::vector<int> bodies = workspace_.selectedBodies();
    if (!workspace_.clipboard || bodies.empty()) return;
    edit([&](EditorDocument& one) { return one.pasteParts(bodies, *workspace_.clipboard); });
}

void Editor::mirrorParts() {
    const std::vector<int> bodies = workspace_.selectedBodies();
    if (!bodies.empty()) edit([&](EditorDocument& one) { return one.mirrorParts(bodies); });
}

void Editor::stepOnce() {
    workspace_.pulls.applyTo(player().simulation());
    player().stepOnce();
}

void Editor::reset() {
    endTransform();
    document().moved("Reset", workspace_.playState());
    restart();
}

void Editor::restart() {
    endTransform();
    workspace_.pulls.pins.clear();
    workspace_.report(player().reset());
}

void Editor::returnToPlay() {
    endTransform();
    if (player().canReturnToPlay()) document().moved("Back to where Play was pressed", workspace_.playState());
    player().returnToPlay();
    workspace_.pulls.applyTo(player().simulation());
}

void Editor::quit() {
    const auto end = [this] {
        quitting_ = true;
        recovery_.end();
    };
    files_.afterUnsaved(end, true);
}

void Editor::listenToDocument() {
    document().follow([this] { return workspace_.playState(); });
}

void Editor::answerRecovery(RecoveryDesk::Answer answer) {
    if (answer != RecoveryDesk::Answer::restore) return recovery_.set(answer);
    files_.afterUnsaved([this] {
        auto opened = recovery_.restore(load_);
        if (!adopt(std::move(opened))) return;
        files_.takeOffer();
        const std::string contents = recovery_.offered()->contents();
        workspace_.say(Toast::Kind::info, "Restored " + contents + "; save it to keep it");
        workspace_.report(recovery_.restored(document()));
    });
}

void Editor::keepRecovery() {
    if (!quitting_) workspace_.report(recovery_.keep(document()));
}

void Editor::toggleHandles() {
    workspace_.showHandles = !workspace_.showHandles;
    workspace_.hotHandle.reset();
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
    camera_.follow();
    for (Toast& toast : workspace_.toasts)
        toast.secondsLeft -= static_cast<float>(seconds);
    std::erase_if(workspace_.toasts, [](const Toast& toast) { return toast.secondsLeft <= 0.0F; });
    if (const std::string news = player().deck().takeNews(); !news.empty()) workspace_.say(Toast::Kind::warning, news);
    if (!quitting_) workspace_.report(recovery_.update(document(), seconds));
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
    EditorDocument::Step last;
    bool moves = false;
    for (; changes != 0; changes += changes < 0 ? 1 : -1) {
        last = changes < 0 ? document().undo() : document().redo();
        moves = moves || last.moves;
    }
    workspace_.follow();
    if (last.play != nullptr) workspace_.restore(*last.play, moves);
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
        if (doll < 0) return;
        changePins("Let go of " + workspace_.nameOf(*active), [&](std::vector<Pull>& pins) {
            std::erase_if(pins, [&](const Pull& pin) { return pin.doll == doll; });
        });
        return;
    }
    const std::string name = document().profile().bodies[active->index].name;
    if (workspace_.pulls.findPin(active->doll, name) != workspace_.pulls.pins.end()) {
        changePins(fmt::format("Let go of {}", name),
                   [&](std::vector<Pull>& pins) { pins.erase(workspace_.pulls.findPin(active->doll, name)); });
        return;
    }
    changePins(fmt::format("Pin {}", name), [&](std::vector<Pull>& pins) {
        pins.push_back({active->doll, name, vec3(0), workspace_.positionOf(*active)});
    });
}

void Editor::unpinAll() {
    if (!workspace_.pulls.pins.empty()) changePins("Let go of all", [](std::vector<Pull>& pins) { pins.clear(); });
}

void Editor::changePins(const std::string& label, const std::function<void(std::vector<Pull>&)>& change) {
    document().moved(label, workspace_.playState(), false);
    change(workspace_.pulls.pins);
    workspace_.pulls.applyTo(player().simulation());
}

void Editor::throwBall() {
    const render::Ray ray = workspace_.mouseRay();
    const vec3 from = ray.origin + ray.direction * std::min(0.5F, workspace_.camera.distance * 0.2F);
    // Lifted a little, so that it meets what the mouse points at in spite of gravity.
    const auto before = workspace_.playState();
    if (workspace_.report(player().throwBall(from, ray.direction * kThrowSpeed + vec3(0, 0.8F, 0)))) return;
    document().moved("Throw a ball", before);
    workspace_.pulls.applyTo(player().simulation());
}

bool Editor::editScene(const std::string& label, const std::string& group,
                       const std::function<void(scene::EntityScene&)>& change) {
    SceneSettings settings = document().sceneDocument().settings();
    change(settings.entities);
    return edit([&](EditorDocument& document) { return document.setScene(settings, label, group); });
}

void Editor::dropCopies(int count) {
    editScene(fmt::format("Drop {} copies", count), "", [&](scene::EntityScene& scene) { addCopies(scene, count); });
}

void Editor::placeCamera(scene::EntityId id) {
    const render::Camera& seen = workspace_.camera;
    const mat3 axes(render::rightOf(seen), render::upOf(seen), -render::forwardOf(seen));
    const RigidTransform world{glm::normalize(glm::quat_cast(axes)), render::eyeOf(seen)};
    editScene("Place the camera at the view", "", [&](scene::EntityScene& scene) {
        scene::placeEntity(scene, id, world);
        scene::Camera& camera = *scene.find<scene::Camera>(id);
        camera.fieldOfView = seen.fieldOfView;
        camera.distance = seen.distance;
        camera.orthographic = seen.orthographic;
    });
}

void Editor::editCharacter(scene::EntityId id) {
    const auto* ragdoll = document().scene().find<scene::Ragdoll>(id);
    if (ragdoll == nullptr) return;
    const auto change = [this, wanted = *ragdoll] {
        const render::Camera seen = workspace_.camera;
        if (adopt(openCharacter(wanted, load_, document()))) workspace_.camera = seen;
    };
    if (document().unsaved()) {
        files_.afterUnsaved(change);
    } else {
        change();
    }
}

void Editor::open(const std::filesystem::path& file) {
    if (scene::isSceneFile(file)) {
        files_.afterUnsaved([this, file] { openSceneNow(file); });
        return;
    }
    if (isProfile(file)) {
        files_.takeOffer();
        if (edit([&](EditorDocument& document) { return document.useProfile(file); })) {
            workspace_.say(Toast::Kind::info, "Opened the profile " + file.filename().string());
        }
        return;
    }
    files_.takeAnyRig();
    files_.afterUnsaved([this, file] {
        auto opened = openModel(file, load_, document());
        if (!opened && scene::wantsAnyRig(opened.error())) files_.offerAnyRig(file);
        adopt(std::move(opened));
    });
}

void Editor::answerAnyRig(bool take) {
    const std::filesystem::path file = files_.takeAnyRig();
    if (!take || file.empty()) return;
    scene::LoadOptions load = load_;
    load.fit.rig = physics::RigKind::any;
    load.fit.weighByVolume = true;
    files_.afterUnsaved([this, file, load] { adopt(openModel(file, load, document())); });
}

void Editor::answerOffer(bool take) {
    const std::filesystem::path file = files_.takeOffer();
    if (take && !file.empty()) open(file);
}

void Editor::openSceneNow(const std::filesystem::path& file) {
    const auto scene = scene::loadScene(file);
    if (!scene) return workspace_.say(Toast::Kind::error, scene.error().text());
    auto other = openScene(file, scene.value(), load_, document());
    if (other && other.value() == nullptr) {
        // The character that is edited is the scene's first one: its ragdoll stays as it is.
        if (!edit([&](EditorDocument& document) { return document.useScene(file, scene.value()); })) return;
        select(std::nullopt);
        restart();
        camera_.frameScene();
    } else if (!adopt(std::move(other))) {
        return;
    }
    workspace_.say(Toast::Kind::info, "Opened the scene " + file.filename().string());
}

bool Editor::adopt(Result<std::unique_ptr<EditorDocument>> opened) {
    if (!opened) {
        workspace_.say(Toast::Kind::error, opened.error().text());
        return false;
    }
    auto player = std::make_unique<Player>(*opened.value(), clock_);
    if (workspace_.report(player->rebuild(Player::Keep::nothing))) return false;
    select(std::nullopt);
    workspace_.pulls.pins.clear();
    player->setPlaying(workspace_.player->playing());
    player->setSpeed(workspace_.player->speed());
    player->setSparing(workspace_.player->sparing());
    workspace_.player->endReplay();
    player->takeOver(std::move(workspace_.player->deck()));
    workspace_.player = std::move(player);  // before the document that the old one borrows
    workspace_.document = std::move(opened).value();
    listenToDocument();
    camera_.frameScene();
    ++characterRevision_;
    workspace_.say(Toast::Kind::info, "Opened " + document().character().file.filename().string());
    files_.greet(true);
    return true;
}

}  // namespace lutka::editor
