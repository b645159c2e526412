#include <fmt/format.h>

#include <memory>

#include "commands.hpp"
#include "core/files.hpp"
#include "editor/application.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "outputs.hpp"

namespace lutka::cli {
namespace {

struct EditCommandOptions {
    RagdollOptions ragdoll;
    SceneOptions scene;
    bool paused = false;
    bool headless = false;
    std::filesystem::path input;
    std::filesystem::path recordInput;
    std::filesystem::path recovery;
    std::vector<std::string> screenshots;
    std::optional<int> frames;
    std::string size;
    float uiScale = 0.0F;
    bool noVsync = false;
    std::string quality = "auto";
    bool spareSubsteps = false;
    bool states = false;
};

editor::ApplicationOptions::Screenshot parseScreenshot(const std::string& text) {
    const std::size_t colon = text.find(':');
    try {
        if (colon != std::string::npos && colon + 1 < text.size()) {
            return {std::stoi(text.substr(0, colon)), text.substr(colon + 1)};
        }
    } catch (const std::exception&) {  // not a number; told below
    }
    leave({ErrorCode::usage, fmt::format("\"{}\" is not FRAME:FILE.png", text), "--screenshot-at", ""});
}

render::RenderQuality qualityFromName(const std::string& name) {
    if (name == "best") return render::RenderQuality::best;
    return name == "fast" ? render::RenderQuality::fast : render::RenderQuality::automatic;
}

editor::ApplicationOptions applicationOptions(EditCommandOptions& options) {
    editor::ApplicationOptions application;
    editor::EditorOptions& edit = application.editor;
    const bool fromFile = options.scene.takeFile(options.ragdoll.model.model);
    edit.model = options.ragdoll.model.model;
    if (fromFile) edit.sceneFile = options.scene.scene;
    if (edit.model.empty() && !fromFile) edit.model = orLeave(findAsset("models/mannequin.glb"));
    // Who looks at a window is asked what becomes of an animal; a script is told.
    if (const auto own = findAsset("models/mannequin.glb"); own && !options.headless && options.input.empty())
        edit.standIn = own.value();
    edit.load = options.ragdoll.load();
    edit.load.import.loadTextures = true;
    edit.scene.scenario = options.scene.scene;
    edit.scene.count = options.scene.count.value_or(1);
    edit.scene.seed = options.scene.seed.value_or(0);
    edit.applyToWorld = [given = options.scene](physics::WorldSettings& world) { given.applyTo(world); };
    application.windowFollowsScale = options.size.empty() && options.input.empty();
    if (!options.size.empty()) edit.window = parseSize(options.size);
    edit.playing = !options.paused;
    application.headless = options.headless;
    if (!options.input.empty()) application.input = orLeave(editor::loadScript(options.input));
    application.recordInput = options.recordInput;
    const std::vector<std::filesystem::path> inputs{edit.model, edit.sceneFile, options.ragdoll.profile.value_or(""),
                                                    options.input};
    keepInputs(options.recordInput, inputs);
    for (const std::string& one : options.screenshots) {
        application.screenshots.push_back(parseScreenshot(one));
        keepInputs(application.screenshots.back().file, inputs);
    }
    for (const auto& shot : application.screenshots) {
        if (!options.frames || shot.frame < *options.frames) continue;
        leave({ErrorCode::usage, fmt::format("frame {} comes after the last of {}", shot.frame, *options.frames),
               "--screenshot-at", "frames count from 0: ask for an earlier one or give more --frames"});
    }
    application.frames = options.frames;
    application.uiScale = options.uiScale;
    application.vsync = !options.noVsync;
    application.quality = qualityFromName(options.quality);
    application.editor.spareSubsteps = options.spareSubsteps;
    // A replay neither depends on what the user did before nor changes it.
    application.settings = !options.headless && options.input.empty();
    application.recovery = options.recovery;
    if (application.settings && options.recovery.empty()) application.recovery = editor::recoveryFolder();
    return application;
}

void runEdit(EditCommandOptions& options) {
    if (options.states) {
        fmt::print("{}", editor::stateDiagram());
        return;
    }
    editor::ApplicationOptions application = applicationOptions(options);
    application.interrupted = interrupted;
    orLeave(editor::runApplication(application));
    leaveIfInterrupted();
}

}  // namespace

void addEdit(const Command& app) {
    auto options = std::make_shared<EditCommandOptions>();
    const Command command = app.add("edit", "Open the editor: watch, drag and edit the ragdoll");
    options->ragdoll.addTo(command);
    command.find("MODEL").required(false).describe("model file, or a scene (*.scene.json); default: our own mannequin");
    options->scene.addTo(command);
    command.flag("--paused", options->paused, "begin paused");
    command.flag("--headless", options->headless, "no window: draw on an EGL context");
    command.option("--input", options->input, "replay window events from a file (*.jsonl)");
    command.option("--record-input", options->recordInput, "write the window's events to a file (*.jsonl)");
    command.option("--recovery", options->recovery,
                   "folder that keeps copies of unsaved work; default: one in the user's state folder, and none for "
                   "scripts");
    command.option("--screenshot-at", options->screenshots, "FRAME:FILE.png, as often as wanted").oneValueEach();
    command.option("--frames", options->frames, "end after so many frames").range(1, 10000000);
    command.option("--size", options->size, "window size, WxH; default: 1280x720, times the size of the panels");
    command.option("--ui-scale", options->uiScale, "size of the panels; default: the monitor's").range(0.5, 4.0);
    command.option("--quality", options->quality, "of the picture: best, fast, or auto: fast where a processor draws")
        .oneOf({"auto", "best", "fast"})
        .showDefault();
    command.flag("--no-vsync", options->noVsync, "don't wait for the monitor");
    command.flag("--spare-substeps", options->spareSubsteps,
                 "while the machine is late, take fewer substeps before the simulation slows down");
    command.flag("--states", options->states, "print the state machine as a Mermaid diagram and end");
    command.onRun([options] { runEdit(*options); });
}

}  // namespace lutka::cli
