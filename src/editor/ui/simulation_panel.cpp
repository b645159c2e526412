/// The right panel's Simulation tab: time, start, forces, solver, what is dropped and thrown, recordings.

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "animation/clip_reference.hpp"
#include "editor/ui/clip_list.hpp"
#include "editor/ui/panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"
#include "scene/run/solver_defaults.hpp"

namespace lutka::editor {
namespace {

float simulationLabelWidth(const PanelContext& context) {
    return context.px(92);
}

/// How a change of the scene is told and undone.
struct Told {
    const char* label;
    const char* group = "";  ///< As in UndoStack.
    bool restart = false;    ///< Whether the scene begins anew …
    bool reframe = false;    ///< … and is another one, to be looked at as a whole.
};

// The settings hold the whole scene: they are copied when something is changed, not to be looked at.
template <class Change>
void change(Editor& editor, const Told& told, const Change& change) {
    SceneSettings scene = editor.document().sceneDocument().settings();
    change(scene);
    const bool done = editor.edit(
        [&](EditorDocument& document) { return document.setScene(scene, told.label, told.group, told.restart); });
    if (done && told.restart) editor.restart();
    if (done && told.reframe) editor.frameScene();
}

template <class Change>
void changeWorld(Editor& editor, const Told& told, const Change& change) {
    lutka::editor::change(editor, told, [&](SceneSettings& scene) { change(scene.entities.simulation.world); });
}

void drawTime(const PanelContext& context) {
    Editor& editor = context.editor;
    Player& player = editor.player();
    const float space = ImGui::GetStyle().ItemSpacing.x;
    const ImVec2 third((ImGui::GetContentRegionAvail().x - 2.0F * space) / 3.0F, 0);
    if (ImGui::Button(player.playing() ? "Pause" : "Play", third)) editor.perform(Action::togglePlay);
    tooltip("Space");
    ImGui::SameLine();
    if (ImGui::Button("Step##one", third)) editor.perform(Action::stepOnce);
    tooltip("Right arrow: one step, and pause");
    ImGui::SameLine();
    if (ImGui::Button("Reset##start", third)) editor.perform(Action::reset);
    tooltip("Ctrl+R: back to the scene's start");
    ImGui::BeginDisabled(!player.canReturnToPlay());
    if (ImGui::Button("Back to where Play was pressed", {-1.0F, 0})) editor.perform(Action::returnToPlay);
    ImGui::EndDisabled();
    const int held = player.held().count();
    const bool canHold = held > 0 || !editor.workspace().selectedBodies().empty();
    ImGui::BeginDisabled(!canHold);
    if (ImGui::Button(held > 0 ? "Let all bodies move###only" : "Only the selected bodies move###only", {-1.0F, 0}))
        editor.perform(Action::selectedOnly);
    ImGui::EndDisabled();
    tooltip("Ctrl+Space: all other bodies are held where they are");
    labelled("Speed", simulationLabelWidth(context));
    auto speed = static_cast<float>(player.speed());
    if (slider("##slow", speed, 0.05F, 1.0F, "%.2f of real time")) player.setSpeed(speed);
}

void drawNamedScene(const PanelContext& context) {
    Editor& editor = context.editor;
    const SceneSettings& scene = editor.document().sceneDocument().settings();
    std::string_view chosen;
    labelled("Scene", simulationLabelWidth(context));
    if (ImGui::BeginCombo("##scenario", scene.scenario.empty() ? "from a file" : scene.scenario.c_str(),
                          ImGuiComboFlags_HeightLarge)) {
        for (const scene::ScenarioInfo& info : scene::scenarioRegistry()) {
            const std::string name(info.name);
            if (ImGui::Selectable(name.c_str(), name == scene.scenario)) chosen = info.name;
            tooltip(std::string(info.summary));
        }
        ImGui::EndCombo();
    }
    tooltip("Takes the place of the present scene's entities, but for those that you added");
    if (!chosen.empty()) {
        change(editor, {"Choose the scene", "", true, true}, [&](SceneSettings& next) { next.scenario = chosen; });
    }
    ImGui::BeginDisabled(scene.scenario.empty());
    labelled("Dolls", simulationLabelWidth(context));
    int count = scene.count;
    if (slider("##count", count, 1, 100, "%d", true)) {
        change(editor, {"Number of dolls", "count", true, true},
               [&](SceneSettings& next) { next.count = std::max(count, 1); });
    }
    labelled("Seed", simulationLabelWidth(context));
    int seed = static_cast<int>(scene.seed);
    if (ImGui::InputInt("##seed", &seed)) {
        change(editor, {"Seed", "", true},
               [&](SceneSettings& next) { next.seed = static_cast<std::uint64_t>(std::max(seed, 0)); });
    }
    tooltip("Varies the start; 0 stands upright");
    ImGui::EndDisabled();
}

// When in the clip the dolls start.
void drawClipTime(const PanelContext& context) {
    Editor& editor = context.editor;
    const scene::ClipStart& start = *editor.document().sceneDocument().settings().clip;
    const auto& clips = editor.document().character().clips;
    const int clip = animation::clipMeant(clips, start.clip);
    labelled("At", simulationLabelWidth(context));
    const float length = clip >= 0 ? clips[clip].seconds() : 1.0F;
    float seconds = start.seconds;
    if (slider("##clipTime", seconds, 0.0F, length, "%.2f s of the clip")) {
        change(editor, {"Start time", "clipTime", true}, [&](SceneSettings& next) { next.clip->seconds = seconds; });
    }
    tooltip("The fall begins with the pose and the velocities that the clip has there");
}

// The pose that dolls start in, unless their own says otherwise: bind, the file's, or a clip at a time.
void drawStart(const PanelContext& context) {
    Editor& editor = context.editor;
    const SceneSettings& scene = editor.document().sceneDocument().settings();
    const char* poses[] = {"Bind pose", "File's node pose"};
    std::optional<int> pose;
    std::optional<scene::ClipStart> clip;
    const auto& clips = editor.document().character().clips;
    labelled("Start pose", simulationLabelWidth(context));
    const std::string shown =
        scene.clip ? "Clip " + shownClip(clips, scene.clip->clip) : poses[static_cast<int>(scene.pose)];
    if (beginClipCombo("##pose", shown)) {
        for (int one = 0; one < 2; ++one) {
            if (ImGui::Selectable(poses[one], !scene.clip && static_cast<int>(scene.pose) == one)) pose = one;
        }
        const std::string present = scene.clip ? scene.clip->clip : "";
        if (const auto chosen = chooseListedClip(clips, present, "Clip ")) clip = scene::ClipStart{*chosen, 0.0F};
        ImGui::EndCombo();
    }
    if (pose || clip) {
        change(editor, {"Start pose", "", true}, [&](SceneSettings& next) {
            if (pose) next.pose = static_cast<scene::StartPose>(*pose);
            next.clip = clip;
        });
    }
    if (editor.document().sceneDocument().settings().clip) drawClipTime(context);
}

/// What the solver does by itself unless the scene overrides it.
template <class T>
struct Override {
    const char* label;
    std::optional<T> physics::WorldSettings::*value;
    T own;  ///< The solver's.
    T least;
    T most;
};

bool dragValue(int& value, const Override<int>& one) {
    return ImGui::DragInt("##value", &value, 0.1F, one.least, one.most);
}

bool dragValue(float& value, const Override<float>& one) {
    return slider("##value", value, one.least, one.most, "%.2f a second");
}

// Ticked it begins with the solver's own value, so that ticking alone changes nothing.
template <class T>
void drawOverride(const PanelContext& context, const Override<T>& one) {
    Editor& editor = context.editor;
    std::optional<T> value = editor.document().scene().simulation.world.*one.value;
    ImGui::PushID(one.label);
    labelled(one.label, simulationLabelWidth(context));
    bool set = value.has_value();
    bool changed = ImGui::Checkbox("##own", &set);
    if (changed) value = set ? std::optional<T>(one.own) : std::nullopt;
    ImGui::SameLine();
    if (value) {
        ImGui::SetNextItemWidth(-1.0F);
        changed = dragValue(*value, one) || changed;
        value = std::clamp(*value, one.least, one.most);
    } else {
        ImGui::AlignTextToFramePadding();
        ImGui::TextColored(mutedColor(), "the solver's own");
    }
    ImGui::PopID();
    if (!changed) return;
    changeWorld(editor, {one.label, one.label}, [&](physics::WorldSettings& world) { world.*one.value = value; });
}

void drawOverrides(const PanelContext& context) {
    using World = physics::WorldSettings;
    const physics::SolverKind solver = context.editor.document().scene().simulation.world.solver;
    const scene::SolverDefaults own = scene::solverDefaults(solver);
    constexpr float mostShare = 0.99F;
    ImGui::BeginDisabled(solver == physics::SolverKind::stock);
    drawOverride<int>(context, {"Substeps", &World::substeps, own.substeps, 1, 64});
    drawOverride<int>(context, {"Iterations", &World::iterations, own.iterations, 1, 1000});
    drawOverride<float>(context, {"Air drag", &World::linearDamping, own.linearDamping, 0.0F, mostShare});
    drawOverride<float>(context, {"Turn drag", &World::angularDamping, own.angularDamping, 0.0F, mostShare});
    ImGui::EndDisabled();
}

bool chooseSolver(physics::SolverKind& solver) {
    const auto isChosen = [&](const physics::SolverEntry& entry) { return entry.kind == solver; };
    const auto* now = std::find_if(physics::kSolvers.begin(), physics::kSolvers.end(), isChosen);
    if (!ImGui::BeginCombo("##solver", now->title)) return false;
    bool changed = false;
    for (const physics::SolverEntry& entry : physics::kSolvers) {
        if (!ImGui::Selectable(entry.title, isChosen(entry)) || isChosen(entry)) continue;
        solver = entry.kind;
        changed = true;
    }
    ImGui::EndCombo();
    return changed;
}

void drawSolver(const PanelContext& context) {
    Editor& editor = context.editor;
    labelled("Solver", simulationLabelWidth(context));
    physics::SolverKind solver = editor.document().scene().simulation.world.solver;
    if (!chooseSolver(solver)) return;
    changeWorld(editor, {"Solver"}, [&](physics::WorldSettings& world) { world.solver = solver; });
}

void drawPhysics(const PanelContext& context) {
    Editor& editor = context.editor;
    const auto& simulation = editor.document().scene().simulation;
    labelled("Gravity", simulationLabelWidth(context));
    vec3 gravity = simulation.world.gravity;
    if (ImGui::DragFloat3("##gravity", &gravity.x, 0.05F, -100.0F, 100.0F, "%.2f")) {
        changeWorld(editor, {"Gravity", "gravity"}, [&](physics::WorldSettings& world) { world.gravity = gravity; });
    }
    tooltip("m/s², in world space");
    labelled("Step", simulationLabelWidth(context));
    int rate = static_cast<int>(std::lround(1.0F / simulation.dt));
    if (slider("##step", rate, 15, 480, "1/%d s", true)) {
        change(editor, {"Step", "step"}, [&](SceneSettings& next) {
            next.entities.simulation.dt = 1.0F / static_cast<float>(std::clamp(rate, 15, 480));
        });
    }
    drawSolver(context);
    drawOverrides(context);
    labelled("Threads", simulationLabelWidth(context));
    int threads = simulation.world.threads;
    if (slider("##threads", threads, 1, 16)) {
        changeWorld(editor, {"Threads", "threads"},
                    [&](physics::WorldSettings& world) { world.threads = std::clamp(threads, 1, 256); });
    }
    bool sleeping = simulation.world.sleeping;
    if (ImGui::Checkbox("Bodies at rest sleep", &sleeping)) {
        changeWorld(editor, {"Sleeping"}, [&](physics::WorldSettings& world) { world.sleeping = sleeping; });
    }
}

void drawThings(const PanelContext& context) {
    Editor& editor = context.editor;
    ImGui::SetNextItemWidth(context.px(110));
    ImGui::InputInt("##copies", &context.state.copies);
    context.state.copies = std::clamp(context.state.copies, 1, 500);
    ImGui::SameLine();
    if (ImGui::Button("Drop copies", {-1.0F, 0})) editor.dropCopies(context.state.copies);
    tooltip("Adds so many of the edited character above the scene, each turned another way");
    if (ImGui::Button("Throw a ball", {-1.0F, 0})) editor.perform(Action::throwBall);
    tooltip("B in the view throws where the mouse points");
}

void drawReplay(const PanelContext& context) {
    Player& player = context.editor.player();
    if (!player.deck().replaying()) return;
    float seconds = static_cast<float>(player.deck().position());
    ImGui::SetNextItemWidth(-1.0F);
    const auto length = static_cast<float>(player.deck().seconds());
    if (slider("##scrub", seconds, 0.0F, length, "%.2f s")) {
        player.setPlaying(false);
        player.scrubTo(static_cast<double>(seconds));
    }
    tooltip("Space plays it, the right arrow shows it step by step");
    if (ImGui::Button("End the replay", {-1.0F, 0})) player.endReplay();
}

void drawTakeName(const PanelContext& context, int index) {
    RecordingDeck& deck = context.editor.player().deck();
    std::string& name = context.state.newName;
    ImGui::SetNextItemWidth(-1.0F);
    if (ImGui::IsWindowAppearing()) {
        name = deck.takes()[static_cast<std::size_t>(index)].name;
        ImGui::SetKeyboardFocusHere();
    }
    if (ImGui::InputText("##takeName", &name, ImGuiInputTextFlags_EnterReturnsTrue)) {
        deck.rename(index, name);
        ImGui::CloseCurrentPopup();
    }
}

// Every take with its name and length; a click means it, a right click renames or removes it.
void drawTakes(const PanelContext& context) {
    Player& player = context.editor.player();
    RecordingDeck& deck = player.deck();
    std::optional<int> removed;
    for (int index = 0; index < static_cast<int>(deck.takes().size()); ++index) {
        const Take& take = deck.takes()[static_cast<std::size_t>(index)];
        ImGui::PushID(index);
        const bool chosen = index == deck.current();
        const std::string line =
            fmt::format("{}  {:.1f} s{}###take", take.name, take.seconds(), take.saved ? "" : " ●");
        if (ImGui::Selectable(line.c_str(), chosen)) {
            if (deck.replaying()) player.endReplay();
            deck.choose(index);
        }
        tooltip(take.saved ? "A right click renames or removes it"
                           : "In no file yet. A right click renames or removes it");
        if (ImGui::BeginPopupContextItem("##of")) {
            drawTakeName(context, index);
            if (ImGui::MenuItem("Remove this take", nullptr, false, !deck.recording() && !deck.replaying()))
                removed = index;
            ImGui::EndPopup();
        }
        ImGui::PopID();
    }
    if (removed) deck.remove(*removed);
}

void drawRecording(const PanelContext& context) {
    Editor& editor = context.editor;
    Player& player = editor.player();
    const RecordingDeck& deck = player.deck();
    const bool has = deck.steps() > 0;
    if (deck.recording()) {
        if (ImGui::Button(fmt::format("Stop ({:.1f} s)###record", deck.seconds()).c_str(), {-1.0F, 0})) {
            player.stopRecording();
        }
    } else {
        ImGui::BeginDisabled(deck.replaying());
        if (ImGui::Button("Record###record", {-1.0F, 0})) player.startRecording();
        ImGui::EndDisabled();
        tooltip("Keeps the bodies of every step from now on, as another take");
    }
    drawTakes(context);
    const float half = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) * 0.5F;
    ImGui::BeginDisabled(deck.recording() || !has || deck.replaying());
    if (ImGui::Button("Replay", {half, 0}) && !editor.workspace().report(player.replay()) && deck.missing() > 0) {
        editor.workspace().say(Toast::Kind::warning,
                               fmt::format("{} of what the take shows are not in the scene now", deck.missing()));
    }
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(!has);
    if (ImGui::Button("Save…", {half, 0})) editor.dialog = Editor::Dialog::saveRecording;
    ImGui::EndDisabled();
    if (ImGui::Button("Open a recording…", {-1.0F, 0})) editor.dialog = Editor::Dialog::openRecording;
    drawReplay(context);
}

}  // namespace

void drawSimulationTab(const PanelContext& context) {
    drawTime(context);
    caption("SCENE");
    drawNamedScene(context);
    drawStart(context);
    drawThings(context);
    caption("MUSCLES");
    drawMuscles(context);
    caption("RECORDING");
    drawRecording(context);
    caption("PHYSICS");
    drawPhysics(context);
    caption("RAGDOLL FIT");
    drawFit(context);
}

}  // namespace lutka::editor
