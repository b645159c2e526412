#pragma once

#include <vector>

#include "options.hpp"
#include "scene/run/bake.hpp"

namespace lutka::cli {

/// What --out and --mesh-out ask for, taken while a simulation runs (or is replayed): at the steps, or at a rate of its
/// own between them.
class BakeOutputs {
  public:
    /// Takes the start. Both must outlive it.
    BakeOutputs(const SimulateOptions& options, scene::Simulation& simulation);
    /// Takes what is due, and writes the meshes of a sequence. Leaves on errors.
    void afterStep();
    /// Writes clips and last meshes. Leaves on errors.
    void write();

  private:
    void sample(float alpha);
    void writeMesh(const std::filesystem::path& file, int doll, float alpha);
    void writeClips() const;
    [[nodiscard]] std::filesystem::path fileOf(const std::filesystem::path& file, int doll) const;

    const SimulateOptions& options_;
    scene::Simulation& simulation_;
    double framesPerSecond_;
    int dolls_;       // that are written
    int frames_ = 0;  // taken so far
    std::vector<scene::ClipBaker> bakers_;
};

}  // namespace lutka::cli
