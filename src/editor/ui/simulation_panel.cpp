/// The right panel's Simulation tab: time, start, forces, solver, what is dropped and thrown, recordings.

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "editor/ui/panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

float labelWidth(const PanelContext& context) {
    return context.px(92);
}

void change(Editor& editor, const SceneSettings& scene, const char* label, const char* group, bool restart) {
    const bool done = editor.edit([&](EditorDocument& document) { return document.setScene(scene, label, group); });
    if (done && restart) editor.perform(Action::reset);
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
    labelled("Speed", labelWidth(context));
    auto speed = static_cast<float>(player.speed());
    if (ImGui::SliderFloat("##slow", &speed, 0.05F, 1.0F, "%.2f of real time")) player.setSpeed(speed);
}

void drawNamedScene(const PanelContext& context) {
    Editor& editor = context.editor;
    SceneSettings scene = editor.document().state().scene;
    labelled("Scene", labelWidth(context));
    if (ImGui::BeginCombo("##scenario", scene.scenario.empty() ? "from a file" : scene.scenario.c_str())) {
        for (const scene::ScenarioInfo& info : scene::scenarioRegistry()) {
            const std::string name(info.name);
            if (ImGui::Selectable(name.c_str(), name == scene.scenario)) {
                scene.scenario = name;
                change(editor, scene, "Choose the scene", "", true);
            }
            tooltip(std::string(info.summary));
        }
        ImGui::EndCombo();
    }
    tooltip("Takes the place of the present scene's entities, but for those that you added");
    ImGui::BeginDisabled(scene.scenario.empty());
    labelled("Dolls", labelWidth(context));
    if (ImGui::SliderInt("##count", &scene.count, 1, 100, "%d", ImGuiSliderFlags_Logarithmic)) {
        scene.count = std::max(scene.count, 1);
        change(editor, scene, "Number of dolls", "count", true);
    }
    labelled("Seed", labelWidth(context));
    int seed = static_cast<int>(scene.seed);
    if (ImGui::InputInt("##seed", &seed)) {
        scene.seed = static_cast<std::uint64_t>(std::max(seed, 0));
        change(editor, scene, "Seed", "", true);
    }
    tooltip("Varies the start; 0 stands upright");
    ImGui::EndDisabled();
}

// The pose that dolls start in, unless their own says otherwise: bind, the file's, or a clip at a time.
void drawStart(const PanelContext& context) {
    Editor& editor = context.editor;
    SceneSettings scene = editor.document().state().scene;
    const auto& clips = editor.document().character().clips;
    const char* poses[] = {"Bind pose", "File's node pose"};
    labelled("Start pose", labelWidth(context));
    const std::string shown = scene.clip ? "Clip " + scene.clip->clip : poses[static_cast<int>(scene.pose)];
    if (ImGui::BeginCombo("##pose", shown.c_str())) {
        for (int pose = 0; pose < 2; ++pose) {
            if (!ImGui::Selectable(poses[pose], !scene.clip && static_cast<int>(scene.pose) == pose)) continue;
            scene.pose = static_cast<scene::StartPose>(pose);
            scene.clip.reset();
            change(editor, scene, "Start pose", "", true);
        }
        for (const animation::Clip& clip : clips) {
            if (!ImGui::Selectable(("Clip " + clip.name).c_str(), scene.clip && scene.clip->clip == clip.name))
                continue;
            scene.clip = scene::ClipStart{clip.name, 0.0F};
            change(editor, scene, "Start pose", "", true);
        }
        ImGui::EndCombo();
    }
    if (!scene.clip) return;
    const auto clip = std::find_if(clips.begin(), clips.end(),
                                   [&](const animation::Clip& one) { return one.name == scene.clip->clip; });
    labelled("At", labelWidth(context));
    const float length = clip != clips.end() ? clip->seconds() : 1.0F;
    if (ImGui::SliderFloat("##clipTime", &scene.clip->seconds, 0.0F, length, "%.2f s of the clip")) {
        change(editor, scene, "Start time", "clipTime", true);
    }
    tooltip("The fall begins with the pose and the velocities that the clip has there");
}

// An override that is off means the solver's own value.
template <class T, class Draw>
void optionalField(const PanelContext& context, const char* label, std::optional<T>& value, T start, const Draw& draw) {
    ImGui::PushID(label);
    bool own = value.has_value();
    labelled(label, labelWidth(context));
    if (ImGui::Checkbox("##own", &own)) {
        value = own ? std::optional<T>(start) : std::nullopt;
        draw(true, value);
    }
    ImGui::SameLine();
    if (value) {
        ImGui::SetNextItemWidth(-1.0F);
        draw(false, value);
    } else {
        ImGui::AlignTextToFramePadding();
        ImGui::TextColored(mutedColor(), "the solver's own");
    }
    ImGui::PopID();
}

void drawPhysics(const PanelContext& context) {
    Editor& editor = context.editor;
    SceneSettings scene = editor.document().state().scene;
    physics::WorldSettings& world = scene.entities.simulation.world;
    labelled("Gravity", labelWidth(context));
    if (ImGui::DragFloat3("##gravity", &world.gravity.x, 0.05F, -100.0F, 100.0F, "%.2f")) {
        change(editor, scene, "Gravity", "gravity", false);
    }
    tooltip("m/s², in world space");
    labelled("Step", labelWidth(context));
    int rate = static_cast<int>(std::lround(1.0F / scene.entities.simulation.dt));
    if (ImGui::SliderInt("##step", &rate, 15, 480, "1/%d s", ImGuiSliderFlags_Logarithmic)) {
        scene.entities.simulation.dt = 1.0F / static_cast<float>(std::clamp(rate, 15, 480));
        change(editor, scene, "Step", "step", false);
    }
    labelled("Solver", labelWidth(context));
    int solver = static_cast<int>(world.solver);
    if (ImGui::Combo("##solver", &solver, "Stock Bullet\0Tuned for ragdolls\0Crowd\0")) {
        world.solver = static_cast<physics::SolverKind>(solver);
        change(editor, scene, "Solver", "", false);
    }
    ImGui::BeginDisabled(world.solver == physics::SolverKind::stock);
    const auto whole = [&](const char* label, int most) {
        return [&, label, most](bool switched, std::optional<int>& value) {
            const bool dragged = !switched && ImGui::DragInt("##value", &*value, 0.1F, 1, most);
            if (dragged) value = std::clamp(*value, 1, most);
            if (switched || dragged) change(editor, scene, label, label, false);
        };
    };
    const auto share = [&](const char* label) {
        return [&, label](bool switched, std::optional<float>& value) {
            constexpr float most = 0.99F;
            const bool dragged = !switched && ImGui::SliderFloat("##value", &*value, 0.0F, most, "%.2f a second");
            if (dragged) value = std::clamp(*value, 0.0F, most);
            if (switched || dragged) change(editor, scene, label, label, false);
        };
    };
    optionalField(context, "Substeps", world.substeps, 8, whole("Substeps", 64));
    optionalField(context, "Iterations", world.iterations, 20, whole("Iterations", 1000));
    optionalField(context, "Air drag", world.linearDamping, 0.02F, share("Air drag"));
    optionalField(context, "Turn drag", world.angularDamping, 0.4F, share("Turn drag"));
    ImGui::EndDisabled();
    labelled("Threads", labelWidth(context));
    if (ImGui::SliderInt("##threads", &world.threads, 1, 16)) {
        world.threads = std::clamp(world.threads, 1, 256);
        change(editor, scene, "Threads", "threads", false);
    }
    if (ImGui::Checkbox("Bodies at rest sleep", &world.sleeping)) change(editor, scene, "Sleeping", "", false);
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
    if (ImGui::SliderFloat("##scrub", &seconds, 0.0F, length, "%.2f s")) {
        player.setPlaying(false);
        player.scrubTo(static_cast<double>(seconds));
    }
    tooltip("Space plays it, the right arrow shows it step by step");
    if (ImGui::Button("End the replay", {-1.0F, 0})) player.endReplay();
}

void drawRecording(const PanelContext& context) {
    Editor& editor = context.editor;
    Player& player = editor.player();
    const bool has = player.deck().steps() > 0;
    if (player.deck().recording()) {
        if (ImGui::Button(fmt::format("Stop ({:.1f} s)###record", player.deck().seconds()).c_str(), {-1.0F, 0})) {
            player.stopRecording();
        }
    } else {
        ImGui::BeginDisabled(player.deck().replaying());
        if (ImGui::Button("Record###record", {-1.0F, 0})) player.startRecording();
        ImGui::EndDisabled();
        tooltip("Keeps the bodies of every step from now on");
    }
    const float half = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) * 0.5F;
    ImGui::BeginDisabled(player.deck().recording() || !has || player.deck().replaying());
    if (ImGui::Button("Replay", {half, 0})) editor.workspace().report(player.replay());
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(!has);
    if (ImGui::Button("Save…", {half, 0})) editor.dialog = Editor::Dialog::saveRecording;
    ImGui::EndDisabled();
    if (ImGui::Button("Open a recording…", {-1.0F, 0})) editor.dialog = Editor::Dialog::openRecording;
    drawReplay(context);
    if (has && !player.deck().recording() && !player.deck().replaying()) {
        mutedText(fmt::format("{} steps, {:.1f} s are kept.", player.deck().steps(), player.deck().seconds()));
    }
}

}  // namespace

void drawSimulationTab(const PanelContext& context) {
    drawTime(context);
    caption("SCENE");
    drawNamedScene(context);
    drawStart(context);
    drawThings(context);
    caption("RECORDING");
    drawRecording(context);
    caption("PHYSICS");
    drawPhysics(context);
    caption("RAGDOLL FIT");
    drawFit(context);
}

}  // namespace lutka::editor
