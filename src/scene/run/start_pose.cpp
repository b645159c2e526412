#include "scene/run/start_pose.hpp"

#include <algorithm>

#include "animation/pose.hpp"
#include "scene/puppet/clip_cast.hpp"

namespace lutka::scene {
namespace {

using physics::BodyState;

std::vector<BodyState> bodiesOf(const RagdollAsset& asset, std::span<const RigidTransform> modelFromJoint) {
    std::vector<BodyState> bodies(asset.profile.bodies.size());
    physics::bodiesFromPose(asset.rig, modelFromJoint, {}, bodies);
    return bodies;
}

std::vector<BodyState> bodiesAt(const RagdollAsset& asset, const animation::Clip& clip, float seconds) {
    std::vector<RigidTransform> pose(asset.character.skeleton.parents.size());
    animation::sampleClip(clip, seconds, pose);
    animation::localToModel(asset.character.skeleton, pose, pose);
    return bodiesOf(asset, pose);
}

}  // namespace

Result<std::vector<BodyState>> startBodies(const RagdollAsset& asset, const SimulationOptions& options,
                                           const Placement& placement) {
    const bool own = placement.clip || placement.pose;
    std::optional<ClipStart> start = own ? placement.clip : options.fromClip;
    if (!start) {
        if (placement.pose.value_or(options.pose) == StartPose::bind) {
            return bodiesOf(asset, asset.character.skeleton.bindModelFromJoint);
        }
        return bodiesOf(asset, animation::nodePose(asset.character.skeleton));
    }
    const auto found = findClipMoment(asset.character, *start);
    if (!found) return found.error();
    const animation::Clip& clip = *found.value().clip;
    const float now = found.value().seconds;
    const float before = std::max(now - options.dt, 0.0F);
    const float after = std::min(now + options.dt, clip.seconds());
    std::vector<BodyState> bodies = bodiesAt(asset, clip, now);
    if (after <= before) return bodies;  // a clip of one frame stands still
    const std::vector<BodyState> a = bodiesAt(asset, clip, before);
    const std::vector<BodyState> b = bodiesAt(asset, clip, after);
    const float perSecond = 1.0F / (after - before);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const RigidTransform& from = a[i].worldFromBody;
        const RigidTransform& to = b[i].worldFromBody;
        bodies[i].linearVelocity = (to.translation - from.translation) * perSecond;
        bodies[i].angularVelocity = rotationVector(to.rotation * glm::conjugate(from.rotation)) * perSecond;
    }
    return bodies;
}

}  // namespace lutka::scene
