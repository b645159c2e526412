#include "run_simulation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "bake_outputs.hpp"
#include "console.hpp"
#include "core/files.hpp"
#include "input_settings.hpp"
#include "interrupt.hpp"
#include "outputs.hpp"
#include "scene/description/scene_file.hpp"
#include "scene/measure/report.hpp"
#include "scene/run/recording.hpp"

namespace lutka::cli {
namespace {

// Outside of this, contact margins and sleeping speeds, which are lengths and speeds of a person's size, mean little.
constexpr float kLeastHeightM = 0.2F;
constexpr float kMostHeightM = 5.0F;

// Writing is the last thing of a long run: what can't be written is better known before it.
void checkWritable(const std::filesystem::path& file) {
    std::error_code failed;
    const bool streamed =
        std::filesystem::is_other(std::filesystem::status(file, failed));  // no file is made beside it
    if (streamed || isStandardOutput(file)) return;
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    std::filesystem::create_directories(folder, failed);
    if (failed || !std::filesystem::is_directory(folder)) {
        leave({ErrorCode::output, "can't be written: its folder can't be made", file.string(),
               "check the path and its permissions"});
    }
    if (std::filesystem::is_directory(file, failed)) {
        leave({ErrorCode::output, "can't be written: it is a folder", file.string(), "give the name of a file"});
    }
    if (::access(folder.c_str(), W_OK) != 0) {
        leave({ErrorCode::output, "can't be written: its folder allows no writing", file.string(),
               "check the folder's permissions"});
    }
}

// A recording fits a model with as many bodies; its steps are all there is.
void checkReplay(const SimulateOptions& options, Run& run) {
    const scene::Recording& recording = *run.replay;
    const scene::Recording expected = scene::beginRecording(*run.simulation);
    if (recording.model != expected.model) {
        spdlog::warn("{}: was recorded with {}", options.replayFrom.string(), recording.model);
    }
    if (recording.bodiesPerDoll != expected.bodiesPerDoll || recording.bodiesOfDoll != expected.bodiesOfDoll ||
        recording.frameSize() != expected.frameSize()) {
        leave({ErrorCode::input,
               fmt::format("was made of {} with {} bodies and {} moving things in all; here they are {} and {}",
                           recording.model, recording.bodiesPerDoll, recording.frameSize(), expected.bodiesPerDoll,
                           expected.frameSize()),
               options.replayFrom.string(), "replay it with the model, profile and scene that it was recorded with"});
    }
    run.steps = recording.steps() - 1;
    run.simulation->show(recording.frame(0));
}

// A run from the same inputs has to give the same bits.
void checkInputs(const SimulateOptions& options, const Run& run) {
    const auto difference = scene::differenceFrom(*run.simulation, *run.inputs);
    if (!difference) return;
    std::string what = fmt::format("prop {}", difference->body + 1);
    if (difference->doll >= 0) {
        const physics::RagdollProfile& profile = run.simulation->assetOf(difference->doll).profile;
        what = fmt::format("{} of doll {}", profile.bodies[difference->body].name, difference->doll + 1);
    }
    const std::string when = difference->step == 0 ? "before the first step"
                                                   : fmt::format("after step {}, within the last {}", difference->step,
                                                                 scene::RunInputs::kStepsACheck);
    const std::string whose = scene::profilesHash(*run.simulation) == run.inputs->profile
                                  ? fmt::format("it was made by {}", run.inputs->program)
                                  : "it was made with another profile";
    leave({ErrorCode::input,
           fmt::format("the run differs {}: {} first, {} bodies in all; {}", when, what, difference->differing, whose),
           options.replayFrom.string(), "replay it with the model, profile, scene and build that made it"});
}

void advance(Run& run, int step) {
    if (!run.replay) {
        run.simulation->step();
        return;
    }
    run.simulation->show(run.replay->frame(step + 1));
}

void checkOutputs(const SimulateOptions& options, const std::filesystem::path& picture) {
    using Endings = std::vector<std::string_view>;
    checkEnding("--out", options.bakedOut, options.together ? Endings{".glb"} : Endings{".glb", ".bvh"}, options.each);
    checkEnding("--mesh-out", options.meshOut, {".obj"}, options.each || options.meshSequence);
    std::vector<std::filesystem::path> taken;
    if (!options.ragdoll.model.model.empty()) taken.push_back(options.ragdoll.model.model);
    if (scene::isSceneFile(options.scene.scene)) taken.emplace_back(options.scene.scene);
    if (options.ragdoll.profile) taken.push_back(*options.ragdoll.profile);
    if (!options.replayFrom.empty()) taken.push_back(options.replayFrom);
    for (const auto& file : {options.bakedOut, options.meshOut, options.report, options.recordTo, picture}) {
        if (file.empty()) continue;
        keepInputs(file, taken);
        taken.push_back(file);
        checkWritable(file);
    }
}

void warnOfHeight(const scene::RagdollAsset& asset) {
    const float height = asset.profile.heightM;
    if (height >= kLeastHeightM && height <= kMostHeightM) return;
    spdlog::warn("{}: stands {:.3g} m tall; the physics is tuned for {} to {} m (--scale)",
                 asset.character.file.string(), height, kLeastHeightM, kMostHeightM);
}

// The scene with its characters, from its file or by its name.
scene::EntityScene loadEverything(const SimulateOptions& options, bool fromFile, Run& run) {
    const std::filesystem::path& model = options.ragdoll.model.model;
    if (fromFile) {
        auto entities = orLeave(scene::loadScene(options.scene.scene));
        const bool figure = options.ragdoll.model.figure.has_value();
        if ((options.ragdoll.profile || figure) && model.empty()) {
            const std::string what = figure ? "figure" : "profile";
            leave({ErrorCode::usage, fmt::format("a {} goes with a MODEL, and there is none", what), "--" + what,
                   fmt::format("give \"{}\" to the characters of the scene file", what)});
        }
        run.cast = orLeave(scene::loadCast(entities, model, options.ragdoll.load()));
        return entities;
    }
    if (model.empty()) {
        leave({ErrorCode::usage, "there is no MODEL", "", "give a rigged character, or a scene file with characters"});
    }
    run.cast.assets.push_back(orLeave(scene::loadRagdoll(model, options.ragdoll.load())));
    auto entities =
        orLeave(scene::makeScene(run.replay ? run.replay->scene : options.scene.scene,
                                 run.replay ? run.replay->dolls : options.scene.count.value_or(1),
                                 options.scene.seed.value_or(0), scene::figureOf(*run.cast.assets.front()).bounds));
    run.cast.assetOfRagdoll.assign(entities.all<scene::Ragdoll>().size(), 0);
    return entities;
}

// A figure that plays a clip begins on its feet, whatever it would be dropped from.
void standOnFloor(scene::EntityScene& entities) {
    for (const scene::Entity& entity : entities.entities) {
        if (entities.find<scene::Ragdoll>(entity.id) == nullptr) continue;
        scene::Transform& transform = *entities.find<scene::Transform>(entity.id);
        transform.parentFromEntity.rotation = quat(1, 0, 0, 0);
        transform.parentFromEntity.translation.y = 0.0F;
    }
    entities.simulation.focus = {0, 0.9F, 0};
}

// --hold: in place of the pins that the scene has itself.
void holdBodies(const SimulateOptions& options, const scene::SceneCast& cast, scene::EntityScene& entities) {
    if (options.hold.empty()) return;
    if (cast.assets.empty()) leave({ErrorCode::usage, "the scene has no character", "--hold", "name a MODEL"});
    for (const std::string& name : options.hold) {
        const bool known = std::any_of(cast.assets.begin(), cast.assets.end(), [&](const auto& asset) {
            return physics::bodyNamed(asset->profile, name) >= 0;
        });
        if (known) continue;
        std::vector<std::string> bodies;
        for (const physics::BodyProfile& body : cast.assets.front()->profile.bodies)
            bodies.push_back(body.name);
        leave({ErrorCode::usage, fmt::format("no body has the name '{}'", name), "--hold",
               fmt::format("the bodies are {}", fmt::join(bodies, ", "))});
    }
    for (scene::Ragdoll& ragdoll : entities.all<scene::Ragdoll>())
        ragdoll.pins = options.hold;
}

// One pass of the clip, where nothing else was asked for.
float secondsOf(const SimulateOptions& options, const Run& run, float ofScene) {
    if (options.seconds) return *options.seconds;
    const scene::ClipCast* cast = run.simulation->clipCast();
    if (cast == nullptr || options.clipSpeed == 0.0F) return ofScene;
    return cast->clipSeconds(0) / std::abs(options.clipSpeed);
}

}  // namespace

Run prepare(SimulateOptions& options, const std::filesystem::path& picture) {
    checkOutputs(options, picture);
    const Stopwatch stopwatch("model and scene");
    Run run;
    if (scene::isInputsFile(options.replayFrom)) {
        run.inputs = orLeave(scene::loadInputs(options.replayFrom));
        takeSettings(run.inputs->settings, options.replayFrom, options);
    } else if (!options.replayFrom.empty()) {
        run.replay = orLeave(scene::loadRecording(options.replayFrom));
    }
    if (run.replay && run.replay->figure > 0 && !options.ragdoll.model.figure && !options.ragdoll.model.model.empty())
        options.ragdoll.model.figure = run.replay->figure;
    const bool fromFile = options.scene.takeFile(options.ragdoll.model.model);
    scene::EntityScene entities = loadEverything(options, fromFile, run);
    for (const auto& asset : run.cast.assets) {
        printWarnings(*asset);
        warnOfHeight(*asset);
    }
    if (!options.clip.empty() && options.scene.scene == "drop") standOnFloor(entities);
    holdBodies(options, run.cast, entities);
    auto scenario = orLeave(scene::compileScene(entities, run.cast.figures(), run.cast.assetOfRagdoll));
    const float sceneSeconds = scenario.seconds;
    const scene::SimulationOptions simulation = options.simulation(entities);
    run.simulation = orLeave(scene::Simulation::create(run.cast.pointers(), std::move(scenario), simulation));
    run.steps = static_cast<int>(std::lround(secondsOf(options, run, sceneSeconds) / simulation.dt));
    if (run.replay) checkReplay(options, run);
    if (run.inputs) {
        run.steps = run.inputs->steps;
        checkInputs(options, run);
    }
    return run;
}

void execute(const SimulateOptions& options, Run& run, const std::function<void(scene::Simulation&)>& afterStep) {
    scene::Simulation& simulation = *run.simulation;
    const Stopwatch stopwatch(fmt::format("{} steps of {} dolls", run.steps, simulation.dollCount()));
    BakeOutputs baked(options, simulation);
    scene::Recording recording = scene::beginRecording(simulation);
    const bool recordInputs = scene::isInputsFile(options.recordTo);
    const bool recordSteps = !options.recordTo.empty() && !recordInputs;
    scene::RunInputs inputs;
    if (recordInputs) {
        inputs = scene::beginInputs(simulation, "lutka " LUTKA_VERSION);
        inputs.settings = inputSettings(options);
    }
    std::optional<scene::InputPlayer> player;
    if (run.inputs) player.emplace(*run.inputs, simulation);
    if (recordSteps) scene::record(simulation, recording);
    Progress progress(run.replay ? "replaying" : "simulating", run.steps);
    for (int step = 0; step < run.steps; ++step) {
        leaveIfInterrupted();
        if (player) player->beforeStep();
        advance(run, step);
        if (run.inputs) checkInputs(options, run);
        if (recordInputs) scene::noteStep(simulation, step + 1 == run.steps, inputs);
        baked.afterStep();
        if (recordSteps) scene::record(simulation, recording);
        if (afterStep) afterStep(simulation);
        progress.at(step + 1);
    }
    baked.write();
    if (recordSteps) orLeave(scene::saveRecording(options.recordTo, recording));
    if (recordInputs) orLeave(scene::saveInputs(options.recordTo, inputs));
    if (!options.report.empty()) orLeave(writeFileAtomically(options.report, scene::reportJson(simulation)));
}

}  // namespace lutka::cli
