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
#include "interrupt.hpp"
#include "scene/bake.hpp"
#include "scene/recording.hpp"
#include "scene/report.hpp"

namespace lutka::cli {
namespace {

// Outside of this, contact margins and sleeping speeds, which are lengths and speeds of a person's size, mean little.
constexpr float kLeastHeightM = 0.3F;
constexpr float kMostHeightM = 5.0F;

void writeLastMesh(const std::filesystem::path& file, Run& run) {
    const animation::Character& character = run.asset->character;
    std::vector<RigidTransform> pose(character.skeleton.parents.size());
    std::vector<animation::SkinMatrix> palette(pose.size());
    run.simulation->pose(0, 1.0F, pose);
    animation::skinMatrices(character.skeleton.bindModelFromJoint, pose, palette);
    orLeave(animation::writeObj(file, character, palette, run.simulation->worldFromModel(0)));
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
    if (recording.bodiesPerDoll != expected.bodiesPerDoll || recording.frameSize() != expected.frameSize()) {
        leave({ErrorCode::input,
               fmt::format("was made of {} with {} bodies; this model has {}", recording.model, recording.bodiesPerDoll,
                           expected.bodiesPerDoll),
               options.replayFrom.string(), "replay it with the model and profile that it was recorded with"});
    }
    run.steps = recording.steps() - 1;
    run.simulation->show(std::span(recording.frames).first(recording.frameSize()));
}

void advance(Run& run, int step) {
    if (!run.replay) {
        run.simulation->step();
        return;
    }
    const std::size_t size = run.replay->frameSize();
    run.simulation->show(std::span(run.replay->frames).subspan(size * (static_cast<std::size_t>(step) + 1), size));
}

void checkOutputs(const SimulateOptions& options, const std::filesystem::path& picture) {
    checkExtension("--out", options.bakedOut, ".glb");
    checkExtension("--mesh-out", options.meshOut, ".obj");
    std::vector<std::filesystem::path> taken = {options.ragdoll.model.model};
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

}  // namespace

Run prepare(const SimulateOptions& options, const std::filesystem::path& picture) {
    checkOutputs(options, picture);
    Run run;
    run.asset = orLeave(scene::loadRagdoll(options.ragdoll.model.model, options.ragdoll.load()));
    printWarnings(*run.asset);
    if (const float height = run.asset->profile.heightM; height < kLeastHeightM || height > kMostHeightM) {
        spdlog::warn("{}: stands {:.3g} m tall; the physics is tuned for {} to {} m (--scale)",
                     run.asset->character.file.string(), height, kLeastHeightM, kMostHeightM);
    }
    if (!options.replayFrom.empty()) run.replay = orLeave(scene::loadRecording(options.replayFrom));
    const scene::FigureBounds figure = scene::figureBounds(run.asset->profile, run.asset->rig);
    auto scenario = orLeave(scene::makeScenario(run.replay ? run.replay->scene : options.scene,
                                                run.replay ? run.replay->dolls : options.count, options.seed, figure,
                                                run.asset->profile.standardFromModel));
    const float seconds = options.seconds.value_or(scenario.seconds);
    const scene::SimulationOptions simulation = options.simulation();
    run.simulation = orLeave(scene::Simulation::create(*run.asset, std::move(scenario), simulation));
    run.steps = static_cast<int>(std::lround(seconds / simulation.dt));
    if (run.replay) checkReplay(options, run);
    return run;
}

void execute(const SimulateOptions& options, Run& run, const std::function<void(scene::Simulation&)>& afterStep) {
    scene::Simulation& simulation = *run.simulation;
    scene::ClipBaker baker(0, 1.0F / simulation.options().dt, "lutka_" + options.scene);
    scene::Recording recording = scene::beginRecording(simulation);
    const bool bake = !options.bakedOut.empty();
    const bool recordSteps = !options.recordTo.empty();
    if (bake) baker.sample(simulation);
    if (recordSteps) scene::record(simulation, recording);
    Progress progress(run.replay ? "replaying" : "simulating", run.steps);
    for (int step = 0; step < run.steps; ++step) {
        leaveIfInterrupted();
        advance(run, step);
        if (bake) baker.sample(simulation);
        if (recordSteps) scene::record(simulation, recording);
        if (afterStep) afterStep(simulation);
        progress.at(step + 1);
    }
    if (bake) {
        orLeave(animation::writeGlb(options.bakedOut, run.asset->character, std::span(&baker.clip(), 1),
                                    simulation.worldFromModel(0)));
    }
    if (!options.meshOut.empty()) writeLastMesh(options.meshOut, run);
    if (recordSteps) orLeave(scene::saveRecording(options.recordTo, recording));
    if (!options.report.empty()) orLeave(writeFileAtomically(options.report, scene::reportJson(simulation)));
}

}  // namespace lutka::cli
