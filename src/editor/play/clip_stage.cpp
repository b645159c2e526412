#include "editor/play/clip_stage.hpp"

#include <algorithm>
#include <cmath>

#include "scene/start_pose.hpp"

namespace lutka::editor {

Result<ClipStage> ClipStage::create(const scene::Simulation& simulation, int doll, const std::string& clip) {
    ClipStage stage;
    stage.start_.clip = clip;
    stage.doll_ = doll;
    const scene::RagdollAsset& asset = simulation.assetOf(doll);
    const auto found = scene::findClipMoment(asset.character, stage.start_);
    if (!found) return found.error();
    stage.length_ = found.value().clip->seconds();
    stage.before_.resize(asset.profile.bodies.size());
    simulation.getBodies(doll, stage.before_);
    return stage;
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
    const RigidTransform& worldFromModel = simulation.worldFromModel(doll_);
    for (physics::BodyState& body : bodies.value()) {
        body.worldFromBody = worldFromModel * body.worldFromBody;
        body.linearVelocity = worldFromModel.rotation * body.linearVelocity;
        body.angularVelocity = worldFromModel.rotation * body.angularVelocity;
    }
    simulation.world().setBodies(simulation.dollId(doll_), bodies.value());
    simulation.refresh();
}

void ClipStage::placeBack(scene::Simulation& simulation) const {
    if (doll_ >= simulation.dollCount() || before_.size() != simulation.assetOf(doll_).profile.bodies.size()) return;
    simulation.world().setBodies(simulation.dollId(doll_), before_);
    simulation.refresh();
}

}  // namespace lutka::editor
