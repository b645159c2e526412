#include "run_simulation.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <optional>

#include "animation/export/write_glb.hpp"
#include "animation/export/write_obj.hpp"
#include "animation/skinning.hpp"
#include "core/files.hpp"
#include "input_settings.hpp"
#include "interrupt.hpp"
#include "scene/bake.hpp"
#include "scene/recording.hpp"
#include "scene/report.hpp"
#include "scene/scene_file.hpp"

namespace lutka::cli {
namespace {

// Outside of this, contact margins and sleeping speeds, which are lengths and speeds of a person's size, mean little.
constexpr float kLeastHeightM = 0.3F;
constexpr float kMostHeightM = 5.0F;

void writeLastMesh(const std::filesystem::path& file, Run& run, int doll) {
    const animation::Character& character = run.simulation->assetOf(doll).character;
    std::vector<RigidTransform> pose(character.skeleton.parents.size());
    std::vector<animation::SkinMatrix> palette(pose.size());
    run.simulation->pose(doll, 1.0F, pose);
    animation::skinMatrices(character.skeleton.bindModelFromJoint, pose, palette);
    orLeave(animation::writeObj(file, character, palette, run.simulation->worldFromModel(doll)));
}

// NAME_0001.glb for the first doll when each has a file of its own.
std::filesystem::path fileOf(const std::filesystem::path& file, const SimulateOptions& options, int doll) {
    if (!options.each) return file;
    std::filesystem::path own = file;
    own.replace_filename(fmt::format("{}_{:04}{}", file.stem().string(), doll + 1, file.extension().string()));
    return own;
}

// Writing is the last thing of a long run: what can't be written is better known before it.
void checkWritable(const std::filesystem::path& file) {
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    std::error_code failed;
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

void checkExtension(const char* option, const std::filesystem::path& file, const char* extension) {
    if (file.empty() || file.extension() == extension) return;
    leave({ErrorCode::usage, fmt::format("'{}' doesn't end in {}", file.string(), extension), option,
           fmt::format("this output is always {}: name it so", extension)});
}

bool sameFile(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code failed;
    const auto full = [&](const std::filesystem::path& file) {
        return std::filesystem::weakly_canonical(file, failed);
    };
    return full(a) == full(b);
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
    checkExtension("--out", options.bakedOut, ".glb");
    checkExtension("--mesh-out", options.meshOut, ".obj");
    std::vector<std::filesystem::path> taken;
    if (!options.ragdoll.model.model.empty()) taken.push_back(options.ragdoll.model.model);
    if (scene::isSceneFile(options.scene.scene)) taken.emplace_back(options.scene.scene);
    if (options.ragdoll.profile) taken.push_back(*options.ragdoll.profile);
    if (!options.replayFrom.empty()) taken.push_back(options.replayFrom);
    for (const auto& file : {options.bakedOut, options.meshOut, options.report, options.recordTo, picture}) {
        if (file.empty()) continue;
        for (const std::filesystem::path& other : taken) {
            if (!sameFile(file, other)) continue;
            leave({ErrorCode::usage, "is named twice: an output would destroy it", file.string(),
                   "give every input and output a name of its own"});
        }
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
    std::vector<scene::ClipBaker> bakers;
    const int written = options.each ? simulation.dollCount() : 1;
    scene::Recording recording = scene::beginRecording(simulation);
    const bool bake = !options.bakedOut.empty();
    const bool recordInputs = scene::isInputsFile(options.recordTo);
    const bool recordSteps = !options.recordTo.empty() && !recordInputs;
    scene::RunInputs inputs;
    if (recordInputs) {
        inputs = scene::beginInputs(simulation, "lutka " LUTKA_VERSION);
        inputs.settings = inputSettings(options);
    }
    std::optional<scene::InputPlayer> player;
    if (run.inputs) player.emplace(*run.inputs, simulation);
    const auto sample = [&] {
        for (scene::ClipBaker& baker : bakers)
            baker.sample(simulation);
    };
    for (int doll = 0; bake && doll < written; ++doll)
        bakers.emplace_back(doll, 1.0F / simulation.options().dt, "lutka_" + simulation.scenario().name);
    sample();
    if (recordSteps) scene::record(simulation, recording);
    Progress progress(run.replay ? "replaying" : "simulating", run.steps);
    for (int step = 0; step < run.steps; ++step) {
        leaveIfInterrupted();
        if (player) player->beforeStep();
        advance(run, step);
        if (run.inputs) checkInputs(options, run);
        if (recordInputs) scene::noteStep(simulation, step + 1 == run.steps, inputs);
        sample();
        if (recordSteps) scene::record(simulation, recording);
        if (afterStep) afterStep(simulation);
        progress.at(step + 1);
    }
    for (int doll = 0; doll < static_cast<int>(bakers.size()); ++doll) {
        orLeave(animation::writeGlb(fileOf(options.bakedOut, options, doll), simulation.assetOf(doll).character,
                                    std::span(&bakers[doll].clip(), 1), simulation.worldFromModel(doll)));
    }
    for (int doll = 0; !options.meshOut.empty() && doll < written; ++doll)
        writeLastMesh(fileOf(options.meshOut, options, doll), run, doll);
    if (recordSteps) orLeave(scene::saveRecording(options.recordTo, recording));
    if (recordInputs) orLeave(scene::saveInputs(options.recordTo, inputs));
    if (!options.report.empty()) orLeave(writeFileAtomically(options.report, scene::reportJson(simulation)));
}

}  // namespace lutka::cli
