#include "bake_outputs.hpp"

#include <fmt/format.h>

#include <cmath>

#include "animation/export/write_glb.hpp"
#include "animation/export/write_obj.hpp"
#include "animation/skinning.hpp"
#include "clip_output.hpp"

namespace lutka::cli {
namespace {

// A moment this near to a step's, in steps, is the step's: 60 frames a second are the very poses of 60 steps.
constexpr double kSameMoment = 1e-4;

// Steps a second; a whole number that is missed by rounding only is meant.
double rateOf(float dt) {
    const double rate = 1.0 / static_cast<double>(dt);
    return std::abs(rate - std::round(rate)) < 1e-3 ? std::round(rate) : rate;
}

}  // namespace

BakeOutputs::BakeOutputs(const SimulateOptions& options, scene::Simulation& simulation)
    : options_(options),
      simulation_(simulation),
      framesPerSecond_(options.bakeFps ? *options.bakeFps : rateOf(simulation.options().dt)),
      dolls_(options.each || options.together ? simulation.dollCount() : 1) {
    for (int doll = 0; !options.bakedOut.empty() && doll < dolls_; ++doll)
        bakers_.emplace_back(doll, static_cast<float>(framesPerSecond_), "lutka_" + simulation.scenario().name);
    sample(1.0F);
}

void BakeOutputs::afterStep() {
    const double dt = static_cast<double>(simulation_.options().dt);
    const double now = simulation_.seconds();
    while (true) {
        const double stepsAgo = (now - frames_ / framesPerSecond_) / dt;
        if (stepsAgo < -kSameMoment) return;
        sample(stepsAgo < kSameMoment ? 1.0F : static_cast<float>(1.0 - stepsAgo));
    }
}

void BakeOutputs::sample(float alpha) {
    for (scene::ClipBaker& baker : bakers_)
        baker.sample(simulation_, alpha);
    for (int doll = 0; options_.meshSequence && doll < dolls_; ++doll) {
        std::filesystem::path file = fileOf(options_.meshOut, doll);
        file.replace_filename(fmt::format("{}_{:04}{}", file.stem().string(), frames_, file.extension().string()));
        writeMesh(file, doll, alpha);
    }
    ++frames_;
}

void BakeOutputs::writeMesh(const std::filesystem::path& file, int doll, float alpha) {
    const animation::Character& character = simulation_.assetOf(doll).character;
    std::vector<RigidTransform> pose(character.skeleton.parents.size());
    std::vector<animation::SkinMatrix> palette(pose.size());
    simulation_.pose(doll, alpha, pose);
    animation::skinMatrices(character.skeleton.bindModelFromJoint, pose, palette);
    orLeave(animation::writeObj(file, character, palette, simulation_.worldFromModel(doll)));
}

// NAME_0001.glb for the first doll when each has a file of its own.
std::filesystem::path BakeOutputs::fileOf(const std::filesystem::path& file, int doll) const {
    if (!options_.each) return file;
    std::filesystem::path own = file;
    own.replace_filename(fmt::format("{}_{:04}{}", file.stem().string(), doll + 1, file.extension().string()));
    return own;
}

void BakeOutputs::writeClips() const {
    if (options_.together) {
        std::vector<animation::GlbFigure> figures;
        figures.reserve(static_cast<std::size_t>(dolls_));
        for (int doll = 0; doll < dolls_; ++doll)
            figures.push_back(
                {&simulation_.assetOf(doll).character, &bakers_[doll].clip(), simulation_.worldFromModel(doll)});
        return orLeave(animation::writeGlbCrowd(options_.bakedOut, bakers_.front().clip().name, figures,
                                                animation::keysKept(options_.allKeys)));
    }
    for (int doll = 0; doll < static_cast<int>(bakers_.size()); ++doll) {
        writeClip(fileOf(options_.bakedOut, doll), simulation_.assetOf(doll).character, bakers_[doll].clip(),
                  simulation_.worldFromModel(doll), options_.allKeys);
    }
}

void BakeOutputs::write() {
    if (!bakers_.empty()) writeClips();
    const bool lastMesh = !options_.meshOut.empty() && !options_.meshSequence;
    for (int doll = 0; lastMesh && doll < dolls_; ++doll)
        writeMesh(fileOf(options_.meshOut, doll), doll, 1.0F);
}

}  // namespace lutka::cli
