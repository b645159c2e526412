#include "scene/run/posed_skins.hpp"

#include <algorithm>

#include "core/assert.hpp"

namespace lutka::scene {

PosedSkins::PosedSkins(std::span<const RagdollAsset* const> assets, const Scenario& scenario, int threads)
    : pool_(threads), made_(scenario.dolls.size()) {
    kinds_.reserve(assets.size());
    for (const RagdollAsset* asset : assets)
        kinds_.push_back({{asset->rig, asset->character.skeleton, pool_}, {}});
    long bodies = 0;
    long joints = 0;
    for (std::size_t doll = 0; doll < scenario.dolls.size(); ++doll) {
        const Placement& placement = scenario.dolls[doll];
        const auto asset = static_cast<std::size_t>(placement.asset);
        kinds_[asset].dolls.push_back(static_cast<int>(doll));
        worldFromModel_.push_back(placement.worldFromModel);
        firstBody_.push_back(bodies);
        firstJoint_.push_back(joints);
        bodies += static_cast<long>(assets[asset]->profile.bodies.size());
        joints += static_cast<long>(assets[asset]->character.skeleton.parents.size());
    }
    poses_.resize(static_cast<std::size_t>(joints));
    palettes_.resize(static_cast<std::size_t>(joints));
    between_.reserve(scenario.dolls.size());
    resting_.reserve(scenario.dolls.size());
    firstJoint_.push_back(joints);
}

void PosedSkins::update(const Bodies& bodies, float alpha) {
    LUTKA_ASSERT(bodies.motions.size() == made_.size());
    posed_ = 0;
    const std::span firstJoint(firstJoint_.data(), made_.size());
    for (Kind& kind : kinds_) {
        between_.clear();
        resting_.clear();
        for (const int doll : kind.dolls) {
            const Motion& motion = bodies.motions[doll];
            const bool between = motion.moves && alpha < 1.0F;
            Made& made = made_[doll];
            const bool same = made.ever && made.revision == motion.revision && made.between == between &&
                              (!between || made.alpha == alpha);
            if (same) continue;
            made = {true, between, alpha, motion.revision};
            (between ? between_ : resting_).push_back(doll);
        }
        kind.poser.run({bodies.previous, bodies.present, alpha, worldFromModel_, firstBody_, firstJoint}, between_,
                       palettes_, poses_);
        kind.poser.run({bodies.previous, bodies.present, 1.0F, worldFromModel_, firstBody_, firstJoint}, resting_,
                       palettes_, poses_);
        posed_ += static_cast<int>(between_.size() + resting_.size());
    }
}

void PosedSkins::show(int doll, const animation::Skeleton& skeleton, std::span<const RigidTransform> modelFromJoint) {
    const auto first = static_cast<std::size_t>(firstJoint_[doll]);
    LUTKA_ASSERT(modelFromJoint.size() == static_cast<std::size_t>(firstJoint_[doll + 1]) - first);
    std::copy(modelFromJoint.begin(), modelFromJoint.end(), poses_.begin() + firstJoint_[doll]);
    animation::skinMatrices(skeleton.bindModelFromJoint, modelFromJoint,
                            std::span(palettes_).subspan(first, modelFromJoint.size()));
    made_[doll].ever = false;
}

}  // namespace lutka::scene
