#include "scene/run/bake.hpp"

#include "animation/pose.hpp"

namespace lutka::scene {

ClipBaker::ClipBaker(int doll, float framesPerSecond, std::string name) : doll_(doll) {
    clip_.name = std::move(name);
    clip_.framesPerSecond = framesPerSecond;
}

void ClipBaker::sample(Simulation& simulation, float alpha) {
    const animation::Skeleton& skeleton = simulation.assetOf(doll_).character.skeleton;
    model_.resize(skeleton.parents.size());
    local_.resize(skeleton.parents.size());
    simulation.pose(doll_, alpha, model_);
    animation::modelToLocal(skeleton, model_, local_);
    clip_.parentFromJoint.append(local_);
    ++clip_.frameCount;
}

}  // namespace lutka::scene
