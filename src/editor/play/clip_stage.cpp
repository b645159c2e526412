#include "editor/play/clip_stage.hpp"

#include <algorithm>
#include <cmath>

#include "scene/puppet/stand_on_ground.hpp"
#include "scene/run/start_pose.hpp"

namespace lutka::editor {

Result<ClipStage> ClipStage::create(const scene::Simulation& simulation, int doll, const std::string& clip) {
    ClipStage stage;
    stage.start_.clip = clip;
    stage.doll_ = doll;
    stage.entity_ = simulation.scenario().dollEntities[doll];
    const scene::RagdollAsset& asset = simulation.assetOf(doll);
    const auto found = scene::findClipMoment(asset.character, stage.start_);
    if (!found) return found.error();
    stage.length_ = found.value().clip->seconds();
    stage.bodies_ = asset.profile.bodies;
    stage.before_.resize(stage.bodies_.size());
    simulation.getBodies(doll, stage.before_);
    stage.findPlace(simulation);
    return stage;
}

// Where the clip begins it stands; as it goes on it may jump or lie there.
void ClipStage::findPlace(const scene::Simulation& simulation) {
    scene::Placement placement;
    placement.clip = scene::ClipStart{start_.clip, 0.0F};
    worldFromModel_ = simulation.worldFromModel(doll_);
    const auto bodies = scene::startBodies(simulation.assetOf(doll_), simulation.options(), placement);
    if (!bodies) return;
    worldFromModel_ = scene::standingPlace(simulation.world(), simulation.assetOf(doll_), simulation.scenario(), doll_,
                                           bodies.value());
}

bool ClipStage::follow(const scene::Simulation& simulation) {
    const auto& dolls = simulation.scenario().dollEntities;
    const auto found = std::find(dolls.begin(), dolls.end(), entity_);
    doll_ = static_cast<int>(found - dolls.begin());
    if (found == dolls.end()) return false;
    findPlace(simulation);
    return true;
}

void ClipStage::seek(float seconds) {
    start_.seconds = std::clamp(seconds, 0.0F, length_);
}

void ClipStage::advance(float seconds) {
    const float next = start_.seconds + seconds;
    seek(loop && next > length_ && length_ > 0.0F ? std::fmod(next, length_) : next);
}

void ClipStage::place(scene::Simulation& simulation) const {
    scene::Placement placement;
    placement.clip = start_;
    auto bodies = scene::startBodies(simulation.assetOf(doll_), simulation.options(), placement);
    if (!bodies) return;  // its file is another one now
    for (physics::BodyState& body : bodies.value()) {
        body.worldFromBody = worldFromModel_ * body.worldFromBody;
        body.linearVelocity = worldFromModel_.rotation * body.linearVelocity;
        body.angularVelocity = worldFromModel_.rotation * body.angularVelocity;
    }
    simulation.world().setBodies(simulation.dollId(doll_), bodies.value());
    simulation.refresh();
}

void ClipStage::placeBack(scene::Simulation& simulation) const {
    const auto states = before(simulation);
    if (!states) return;
    simulation.world().setBodies(simulation.dollId(doll_), *states);
    simulation.refresh();
}

std::optional<std::vector<physics::BodyState>> ClipStage::before(const scene::Simulation& simulation) const {
    std::vector<physics::BodyState> states;
    for (const physics::BodyProfile& body : simulation.assetOf(doll_).profile.bodies) {
        const auto was = std::find_if(bodies_.begin(), bodies_.end(), [&](const physics::BodyProfile& one) {
            return one.name == body.name && one.jointPath == body.jointPath;
        });
        if (was == bodies_.end()) return std::nullopt;
        physics::BodyState& state = states.emplace_back(before_[was - bodies_.begin()]);
        // The joint stays where it was, also where the shape was moved in it.
        const RigidTransform& old = was->jointFromBody;
        if (old.rotation == body.jointFromBody.rotation && old.translation == body.jointFromBody.translation) continue;
        state.worldFromBody = state.worldFromBody * inverse(old) * body.jointFromBody;
    }
    return states;
}

}  // namespace lutka::editor
