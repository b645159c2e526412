#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "physics/collision/static_distance.hpp"
#include "scene/puppet_cast.hpp"

namespace lutka::scene {

using physics::BodyState;
using physics::PuppetState;

void PuppetCast::JointTally::add(const JointTally& other) {
    squares += other.squares;
    count += other.count;
    maxDeg = std::max(maxDeg, other.maxDeg);
}

float PuppetCast::JointTally::rmsDeg() const {
    return count > 0 ? static_cast<float>(std::sqrt(squares / static_cast<double>(count))) : 0.0F;
}

// By the name of the body below, in the order of the profiles; characters that share a name share its figures.
std::vector<std::pair<std::string, PuppetCast::JointTally>> PuppetCast::jointTallies() const {
    std::vector<std::pair<std::string, JointTally>> joints;
    for (std::size_t asset = 0; asset < tallies_.size(); ++asset) {
        const physics::RagdollProfile& profile = assets_[asset]->profile;
        for (std::size_t i = 0; i < tallies_[asset].size(); ++i) {
            const std::string& name = profile.bodies[profile.constraints[i].child].name;
            auto known = std::find_if(joints.begin(), joints.end(), [&](const auto& one) { return one.first == name; });
            if (known == joints.end()) known = joints.insert(joints.end(), {name, {}});
            known->second.add(tallies_[asset][i]);
        }
    }
    return joints;
}

// How near feet that stand in the clip are to the ground. Bodies are in frames_ after a step.
void PuppetCast::measureFooting(const Actor& actor) {
    if (!actor.terrain || actor.rising || actor.puppet->state() != PuppetState::animated) return;
    for (int leg = 0; leg < 2; ++leg) {
        const int foot = actor.feet[leg].body;
        if (foot < 0 || !actor.terrain->stands(leg)) continue;
        float nearest = 1e9F;
        for (const physics::StaticShape& shape : statics_)
            nearest = std::min(
                nearest, physics::distanceToStatic(actor.asset->profile.bodies[foot].shape, frames_[foot], shape));
        worst_.footGapM = std::max(worst_.footGapM, nearest);
        worst_.footDepthM = std::max(worst_.footDepthM, -nearest);
        gapsM_ += static_cast<double>(std::max(nearest, 0.0F));
        ++standing_;
    }
}

void PuppetCast::measure() {
    feelContacts();
    for (Actor& actor : actors_) {
        if (actor.puppet->state() == physics::PuppetState::limp) continue;
        const physics::RagdollProfile& profile = actor.asset->profile;
        bodies_.resize(profile.bodies.size());
        world_->getBodies(actor.puppet->doll(), bodies_);
        frames_.clear();
        for (const BodyState& body : bodies_)
            frames_.push_back(body.worldFromBody);
        errors_.resize(profile.constraints.size());
        if (actor.rising) measureRising(actor);
        measureFeet(actor);
        measureFooting(actor);
        for (std::size_t i = 0; i < frames_.size(); ++i)
            if (actor.puppet->weightOf(static_cast<int>(i)) >= 1.0F)
                worst_.ledM = std::max(worst_.ledM, glm::distance(frames_[i].translation, actor.to[i].translation));
        physics::jointErrors(profile, actor.to, frames_, errors_);
        std::vector<JointTally>& tallies = tallies_[actor.assetIndex];
        tallies.resize(errors_.size());
        for (std::size_t i = 0; i < errors_.size(); ++i) {
            const float degreesOff = degrees(errors_[i]);
            tallies[i].squares += static_cast<double>(degreesOff) * static_cast<double>(degreesOff);
            tallies[i].maxDeg = std::max(tallies[i].maxDeg, degreesOff);
            ++tallies[i].count;
        }
        worst_.rootM =
            std::max(worst_.rootM, glm::distance(frames_[actor.root].translation, actor.to[actor.root].translation));
    }
}

PuppetFigures PuppetCast::figures() const {
    PuppetFigures figures = worst_;
    figures.clipReachDeg = reach_.clipReachDeg;
    figures.clipReachJoint = reach_.clipReachJoint;
    JointTally all;
    for (const auto& [name, tally] : jointTallies()) {
        if (tally.maxDeg > all.maxDeg) figures.worstJoint = name;
        all.add(tally);
        figures.joints.push_back({name, tally.rmsDeg(), tally.maxDeg});
    }
    figures.rmsDeg = all.rmsDeg();
    figures.maxDeg = all.maxDeg;
    figures.footGapMeanM = standing_ > 0 ? static_cast<float>(gapsM_ / static_cast<double>(standing_)) : 0.0F;
    figures.limp = static_cast<int>(std::count_if(actors_.begin(), actors_.end(), [](const Actor& actor) {
        return actor.puppet->state() == physics::PuppetState::limp;
    }));
    return figures;
}

}  // namespace lutka::scene
