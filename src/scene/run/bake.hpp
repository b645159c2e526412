#pragma once

#include <vector>

#include "animation/clip.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::scene {

/// Collects a doll's poses while a simulation runs and gives them as a clip of the character.
class ClipBaker {
  public:
    /// `framesPerSecond`: the rate at which `sample` will be called.
    ClipBaker(int doll, float framesPerSecond, std::string name);

    /// Takes the pose `alpha` of the way from the state before the last step to the present one.
    void sample(Simulation& simulation, float alpha = 1.0F);
    [[nodiscard]] const animation::Clip& clip() const { return clip_; }

  private:
    int doll_;
    animation::Clip clip_;
    std::vector<RigidTransform> model_;
    std::vector<RigidTransform> local_;
};

}  // namespace lutka::scene
