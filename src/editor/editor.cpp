#include "editor/editor.hpp"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "animation/export/write_glb.hpp"
#include "scene/bake.hpp"

namespace lutka::editor {
namespace {

constexpr float kThrowSpeed = 9.0F;  // m/s

// The scene's own view, a little farther off: bars lie over the picture's edges.
render::Camera startCamera(const scene::Simulation& simulation, render::Extent window) {
    constexpr float room = 1.15F;
    render::Camera camera = scene::cameraFor(simulation.scenario(), window.aspect());
    render::dolly(camera, room);
    return camera;
}

bool isProfile(const std::filesystem::path& file) {
    return file.extension() == ".json";
}

}  // namespace

Result<std::unique_ptr<Editor>> Editor::create(const EditorOptions& options) {
    auto document = EditorDocument::open(options.model, options.load);
    if (!document) return document.error();
    return create(std::move(document).value(), options);
}

Result<std::unique_ptr<Editor>> Editor::create(std::unique_ptr<EditorDocument> document, const EditorOptions& options) {
    std::unique_ptr<Editor> editor(new Editor);
    editor->workspace_.window = options.window;
    editor->load_ = options.load;
    editor->clock_ = options.clock;
    document->startScene(options.scene);
    auto player = std::make_unique<Player>(*document, options.clock);
    if (auto built = player->rebuild(Player::Keep::nothing); !built) return built.error();
    editor->workspace_.document = std::move(document);
    editor->workspace_.player = std::move(player);
    editor->player().setPlaying(options.playing);
    editor->view.layers.capsules = true;
    editor->view.layers.limits = true;
    editor->workspace_.camera = startCamera(editor->player().simulation(), options.window);
    editor->machine_ = std::make_unique<StateMachine>(makeHandlers(editor->workspace_));
    for (const std::string& warning : editor->document().character().warnings)
        editor->workspace_.log.push_back(warning);
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
    machine_->mouseButton(event);
}

void Editor::handleKey(const InputEvent& event, const UiCapture& capture) {
    if (capture.keyboard || asking()) return;
    if (view.help && event.pressed && event.key == Key::escape) {
        view.help = false;
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
    if (performOnDocument(action) || performOnSimulation(action)) return;
    switch (action) {
        case Action::selectNone:
            select(std::nullopt);
            break;
        case Action::focus:
            focus();
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
            workspace_.report(save(document().profileFile()));
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
            endTransform();
            action == Action::undo ? document().undo() : document().redo();
            workspace_.follow();
            machine_->fire(workspace_.ended());
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
            workspace_.pulls.applyTo(player.simulation().world());
            player.stepOnce();
            return true;
        case Action::reset:
            endTransform();
            workspace_.pulls.pins.clear();
            workspace_.report(player.reset());
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
    workspace_.pulls.applyTo(workspace_.player->simulation().world());
    workspace_.player->advance(seconds);
    for (Toast& toast : workspace_.toasts)
        toast.secondsLeft -= static_cast<float>(seconds);
    std::erase_if(workspace_.toasts, [](const Toast& toast) { return toast.secondsLeft <= 0.0F; });
}

bool Editor::edit(const std::function<Result<void>(EditorDocument&)>& change) {
    endTransform();
    const bool failed = workspace_.report(change(document()));
    workspace_.follow();
    machine_->fire(workspace_.ended());
    return !failed;
}

void Editor::endTransform() {
    if (busy()) machine_->fire(workspace_.ended());
}

void Editor::select(std::optional<Item> item, bool add) {
    endTransform();
    if (!item) {
        workspace_.selection.clear();
    } else if (add) {
        workspace_.selection.toggle(*item);
    } else {
        workspace_.selection.set(*item);
    }
    machine_->fire(workspace_.selection.empty() ? Trigger::pickedNothing : Trigger::picked);
}

void Editor::beginAdd(SceneObject::Kind kind) {
    endTransform();
    workspace_.addKind = kind;
    machine_->fire(Trigger::addKey);
}

void Editor::afterUnsaved(std::function<void()> then) {
    if (!document().unsaved()) {
        then();
        return;
    }
    endTransform();
    afterAnswer_ = std::move(then);
}

void Editor::answer(Answer answer) {
    const auto then = std::exchange(afterAnswer_, nullptr);
    if (then == nullptr || answer == Answer::cancel) return;
    if (answer == Answer::save && workspace_.report(save(document().profileFile()))) return;
    then();
}

void Editor::open(const std::filesystem::path& file) {
    if (isProfile(file)) {
        if (edit([&](EditorDocument& document) { return document.useProfile(file); })) {
            workspace_.say(Toast::Kind::info, "Opened the profile " + file.filename().string());
        }
        return;
    }
    afterUnsaved([this, file] { openNow(file); });
}

void Editor::openNow(const std::filesystem::path& file) {
    scene::LoadOptions load = load_;
    load.profile.reset();  // it belongs to the first model
    auto opened = EditorDocument::open(file, load);
    if (!opened) {
        workspace_.say(Toast::Kind::error, opened.error().text());
        return;
    }
    adopt(std::move(opened).value());
}

void Editor::adopt(std::unique_ptr<EditorDocument> document) {
    document->startScene(workspace_.document->state().scene);
    auto player = std::make_unique<Player>(*document, clock_);
    if (workspace_.report(player->rebuild(Player::Keep::nothing))) return;
    select(std::nullopt);
    workspace_.pulls.pins.clear();
    player->setPlaying(workspace_.player->playing());
    player->setSpeed(workspace_.player->speed());
    workspace_.player = std::move(player);  // before the document that the old one borrows
    workspace_.document = std::move(document);
    workspace_.camera = startCamera(workspace_.player->simulation(), workspace_.window);
    ++characterRevision_;
    workspace_.say(Toast::Kind::info, "Opened " + this->document().character().file.filename().string());
    for (const std::string& warning : this->document().character().warnings)
        workspace_.log.push_back(warning);
}

Result<void> Editor::save(const std::filesystem::path& file) {
    auto saved = document().save(file);
    if (saved) workspace_.say(Toast::Kind::info, "Saved " + file.string());
    return saved;
}

Result<void> Editor::exportBaked(const std::filesystem::path& file, float seconds) {
    endTransform();
    const bool wasPlaying = player().playing();
    // The document's asset lends itself to one simulation at a time: the export takes the scene from its start.
    if (auto reset = player().reset(); !reset) return reset;
    scene::Simulation& simulation = player().simulation();
    const float rate = 1.0F / simulation.options().dt;
    scene::ClipBaker baker(0, rate, "lutka_" + document().state().scene.scenario);
    baker.sample(simulation);
    for (int step = 0; step < static_cast<int>(std::lround(seconds * rate)); ++step) {
        simulation.step();
        baker.sample(simulation);
    }
    auto written =
        animation::writeGlb(file, document().character(), std::span(&baker.clip(), 1), simulation.worldFromModel(0));
    player().setPlaying(wasPlaying);
    if (written) workspace_.say(Toast::Kind::info, fmt::format("Exported {:.1f} s to {}", seconds, file.string()));
    return written;
}

void Editor::togglePin() {
    const auto active = workspace_.selection.active();
    if (!active || active->kind != Item::Kind::body) return;
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
    workspace_.pulls.applyTo(player().simulation().world());
}

void Editor::focus() {
    render::Camera& camera = workspace_.camera;
    const float aspect = workspace_.window.aspect();
    if (const auto active = workspace_.selection.active()) {
        constexpr float bodyRadius = 0.45F;
        render::frameSphere(camera, workspace_.positionOf(*active), bodyRadius, aspect);
        return;
    }
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

void Editor::axisView(float yaw, float pitch) {
    workspace_.camera.yaw = yaw;
    workspace_.camera.pitch = pitch;
    render::orbit(workspace_.camera, 0.0F, 0.0F);  // keeps off the pole
}

}  // namespace lutka::editor
