#include "editor/editor.hpp"

#include <fmt/format.h>

#include <array>
#include <glm/geometric.hpp>

#include "editor/files/folder_files.hpp"
#include "editor/view/select_bodies.hpp"

namespace lutka::editor {

Result<std::unique_ptr<Editor>> Editor::create(const EditorOptions& options) {
    const bool fromScene = !options.sceneFile.empty();
    const auto all = fromScene ? withSceneRead(options) : Result<EditorOptions>(options);
    if (!all) return all.error();
    std::unique_ptr<Editor> editor(new Editor);
    const EditorOptions heard = editor->hearReaders(all.value());
    // What the scene says of its first character is not for those that are opened later.
    scene::LoadOptions load = heard.load;
    takeAs(heard.asInScene, load);
    auto document = EditorDocument::open(heard.model, load, heard.load.fit);
    const bool isOffered = !document && !fromScene && !heard.standIn.empty() && scene::wantsAnyRig(document.error());
    FileFlow::AnyRigOffer offer;
    if (isOffered) {
        offer = {heard.model, document.error().message, heard.load.import.figure, heard.load.profile.value_or("")};
        scene::LoadOptions plain;
        plain.import.loadTextures = heard.load.import.loadTextures;
        document = EditorDocument::open(heard.standIn, plain, heard.load.fit);
    }
    if (!document) return document.error();
    if (auto begun = editor->begin(std::move(document).value(), heard); !begun) return begun.error();
    if (isOffered) editor->opening_.offerAnyRig(std::move(offer));
    if (fromScene) editor->document().sceneDocument().setFile(options.sceneFile);
    return editor;
}

Result<std::unique_ptr<Editor>> Editor::create(std::unique_ptr<EditorDocument> document, const EditorOptions& options) {
    std::unique_ptr<Editor> editor(new Editor);
    if (auto begun = editor->begin(std::move(document), editor->hearReaders(options)); !begun) return begun.error();
    return editor;
}

EditorOptions Editor::hearReaders(EditorOptions options) {
    std::function<void(const std::string&)>& printed = options.load.import.worker.printed;
    printed = [this, others = printed](const std::string& line) {
        workspace_.note(Toast::Kind::info, line);
        if (others) others(line);
    };
    return options;
}

Result<void> Editor::begin(std::unique_ptr<EditorDocument> opened, const EditorOptions& options) {
    workspace_.window = options.window;
    opening_.begin(options.load, options.clock);
    SceneSettings scene = options.scene;
    if (options.applyToWorld) options.applyToWorld(scene.entities.simulation.world);
    if (auto started = opened->startScene(scene); !started) return started;
    auto simulated = std::make_unique<Player>(*opened, options.clock);
    if (auto built = simulated->rebuild(Player::Keep::nothing); !built) return built;
    opening_.take(std::move(opened), std::move(simulated));
    player().setPlaying(options.playing);
    player().setSparing(options.spareSubsteps);
    view.layers.capsules = true;
    view.layers.limits = true;
    machine_ = std::make_unique<StateMachine>(makeHandlers(workspace_));
    files_.greet(!options.load.profile.has_value());
    if (options.recovery.empty()) return {};
    if (const auto begun = recovery_.begin(options.recovery); !begun)
        workspace_.say(Toast::Kind::warning, begun.error().text());
    return {};
}

Editor::Editor()
    : files_(workspace_, [this] { endTransform(); }),
      opening_(workspace_, motion_, camera_, files_, [this] { settle(); }) {}

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
            if (!event.files.empty()) open(fileToOpen(event.files));
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
    if (event.pressed && answersBy(event)) return;
    const auto action = actionFor(event);
    // While something is under way letters and digits are its own, but time and debug draw are everybody's.
    const bool always = action == Action::togglePlay || action == Action::toggleDebug;
    if (action && (always || !busy())) {
        if (!event.repeated || action == Action::stepOnce || action == Action::undo) perform(*action);
        return;
    }
    machine_->key(event);
}

// What stands over the view takes its keys first, and each key answers one thing. What is under way in the view has its
// own Enter and Esc, so an offer waits for its end.
bool Editor::answersBy(const InputEvent& event) {
    const bool escape = event.key == Key::escape;
    const bool offered = !busy() && !files_.offeredAnyRig().model.empty();
    if (escape && view.help) {
        view.help = false;
    } else if (escape && swing() != nullptr) {
        endSwing();
    } else if (offered && !event.repeated && (escape || event.key == Key::enter)) {
        answerAnyRig(escape ? AnyRig::leave : AnyRig::whole);
    } else {
        return false;
    }
    return true;
}

// In the order of Action.
std::span<const Editor::Command> Editor::commands() {
    static constexpr std::array kCommands{
        Command{Action::openModel, true, [](Editor& e) { e.dialog = Dialog::openModel; }},
        Command{Action::openRecent, true, [](Editor& e) { e.view.gallery = !e.view.gallery; }},
        Command{Action::nextFile, true, [](Editor& e) { e.openBeside(1); }},
        Command{Action::previousFile, true, [](Editor& e) { e.openBeside(-1); }},
        Command{Action::reload, true, [](Editor& e) { e.reload(); }},
        Command{Action::saveProfile, true, [](Editor& e) { e.files_.saveAll(); }},
        Command{Action::saveProfileAs, true, [](Editor& e) { e.dialog = Dialog::saveAs; }},
        Command{Action::saveScene, true,
                [](Editor& e) { e.files_.requestSaveScene(e.document().sceneDocument().file()); }},
        Command{Action::saveSceneAs, true, [](Editor& e) { e.dialog = Dialog::saveSceneAs; }},
        Command{Action::exportBaked, true, [](Editor& e) { e.dialog = Dialog::exportBaked; }},
        Command{Action::exportRagdoll, true, [](Editor& e) { e.dialog = Dialog::exportRagdoll; }},
        Command{Action::quit, true, [](Editor& e) { e.quit(); }},
        Command{Action::undo, true, [](Editor& e) { e.travel(-1); }},
        Command{Action::redo, true, [](Editor& e) { e.travel(1); }},
        Command{Action::selectNone, true, [](Editor& e) { e.select(std::nullopt); }},
        Command{Action::copyPart, true, [](Editor& e) { e.onBodies(&BodyCommands::copy); }},
        Command{Action::pastePart, true, [](Editor& e) { e.onBodies(&BodyCommands::paste); }},
        Command{Action::mirrorParts, true, [](Editor& e) { e.onBodies(&BodyCommands::mirror); }},
        Command{Action::addBody, true, [](Editor& e) { e.beginPickJoint(std::nullopt); }},
        Command{Action::removeBodies, true, [](Editor& e) { e.onBodies(&BodyCommands::remove); }},
        Command{Action::mergeBodies, true, [](Editor& e) { e.onBodies(&BodyCommands::merge); }},
        Command{Action::splitBodies, true, [](Editor& e) { e.onBodies(&BodyCommands::split); }},
        Command{Action::toggleSymmetric, false, [](Editor& e) { e.onBodies(&BodyCommands::toggleSymmetric); }},
        Command{Action::nextTool, false, [](Editor& e) { e.nextTool(); }},
        Command{Action::toggleLocalAxes, false, [](Editor& e) { e.workspace_.localAxes = !e.workspace_.localAxes; }},
        Command{Action::swingLimits, true, [](Editor& e) { e.swingLimits(); }},
        Command{Action::pin, true, [](Editor& e) { e.pins_.toggle(); }},
        Command{Action::unpinAll, true, [](Editor& e) { e.pins_.letAllGo(); }},
        Command{Action::togglePlay, true, [](Editor& e) { e.player().setPlaying(!e.player().playing()); }},
        Command{Action::stepOnce, true, [](Editor& e) { e.motion_.stepOnce(); }},
        Command{Action::reset, true,
                [](Editor& e) {
                    e.endTransform();
                    e.motion_.reset();
                }},
        Command{Action::throwBall, true, [](Editor& e) { e.motion_.throwBall(); }},
        Command{Action::returnToPlay, true,
                [](Editor& e) {
                    e.endTransform();
                    e.motion_.returnToPlay();
                }},
        Command{Action::selectedOnly, true, [](Editor& e) { e.motion_.toggleSelectedOnly(); }},
        Command{Action::fallFromClip, true, [](Editor& e) { e.motion_.fallFromClip(); }},
        Command{Action::goLimp, true, [](Editor& e) { e.setPuppets(std::nullopt); }},
        Command{Action::getUp, true, [](Editor& e) { e.setPuppets(e.motion_.gettingUp()); }},
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
        Command{Action::toggleClips, false, [](Editor& e) { e.motion_.toggleClips(e.view.clips); }},
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

void Editor::onBodies(void (BodyCommands::*command)()) {
    endTransform();
    (bodies_.*command)();
    settle();
}

void Editor::addBody(int joint) {
    endTransform();
    endSwing();
    bodies_.add(joint);
    settle();
}

void Editor::nextTool() {
    workspace_.tool = static_cast<Tool>((static_cast<int>(workspace_.tool) + 1) % kToolCount);
    workspace_.hotGizmo.reset();
}

void Editor::restart() {
    endTransform();
    motion_.restart();
}

void Editor::quit() {
    const auto end = [this] {
        quitting_ = true;
        recovery_.end();
    };
    files_.afterUnsaved(end, true);
}

void Editor::answerRecovery(RecoveryDesk::Answer answer) {
    if (answer != RecoveryDesk::Answer::restore) return recovery_.set(answer);
    files_.afterUnsaved([this] {
        auto opened = recovery_.restore(opening_.load());
        if (!opening_.adopt(std::move(opened))) return;
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
    workspace_.skinShown = view.skinOpacity > 0.0F;
    machine_->update();
    workspace_.follow();
    workspace_.pulls.applyTo(workspace_.player->simulation());
    if (workspace_.pulls.mouse) motion_.fallFromClip();
    if (const auto hit = std::exchange(workspace_.hit, std::nullopt)) motion_.hit(*hit);
    if (!motion_.advanceSwing(seconds)) player().advance(seconds);
    camera_.follow();
    for (Toast& toast : workspace_.toasts)
        toast.secondsLeft -= static_cast<float>(seconds);
    std::erase_if(workspace_.toasts, [](const Toast& toast) { return toast.secondsLeft <= 0.0F; });
    if (const std::string news = player().takeNews(); !news.empty()) workspace_.say(Toast::Kind::warning, news);
    if (!quitting_) workspace_.report(recovery_.update(document(), seconds));
    if (watching && !busy() && !files_.asking() && opening_.fileChanged(seconds)) reload();
}

void Editor::swingLimits() {
    endTransform();
    motion_.swingLimits();
}

void Editor::beginPickJoint(std::optional<animation::Role> role) {
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
    const bool done = workspace_.edit(change);
    settle();
    return done;
}

void Editor::travel(int changes) {
    endTransform();
    endSwing();
    motion_.travel(changes);
    settle();
}

void Editor::settle() {
    machine_->fire(workspace_.ended());
}

void Editor::endTransform() {
    if (busy()) settle();
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

bool Editor::editScene(const std::string& label, const std::string& group,
                       const std::function<void(scene::EntityScene&)>& change) {
    SceneSettings settings = document().sceneDocument().settings();
    change(settings.entities);
    return edit([&](EditorDocument& document) { return document.setScene(settings, label, group); });
}

void Editor::dropCopies(int count) {
    editScene(fmt::format("Drop {} copies", count), "", [&](scene::EntityScene& scene) { addCopies(scene, count); });
}

void Editor::setPuppets(const std::optional<scene::ScenePuppets>& puppets) {
    SceneSettings settings = document().sceneDocument().settings();
    settings.entities.simulation.puppets = puppets;
    const char* label = puppets ? "Muscles on" : "Go limp";
    // Undo of both brings back who stood, walked, lay or had yet to fall, and where: else a figure that lies would be
    // led to where it began, and one that was put on the floor would stay there.
    edit([&](EditorDocument& document) { return document.setScene(settings, label, "", true); });
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

}  // namespace lutka::editor
