#include "scene/reachable_clip.hpp"

#include <glm/geometric.hpp>

#include "animation/pose.hpp"
#include "physics/powered/pose_drive.hpp"
#include "physics/powered/reachable_pose.hpp"

namespace lutka::scene {

ReachableClip reachableClip(const RagdollAsset& asset, const animation::Clip& clip, std::vector<bool> keeps) {
    const animation::Skeleton& skeleton = asset.character.skeleton;
    const std::size_t joints = skeleton.parents.size();
    physics::ReachablePose reachable(asset.profile, std::move(keeps));
    ReachableClip out;
    out.clip = clip;
    out.clip.parentFromJoint = {};
    std::vector<RigidTransform> pose(joints), model(joints);
    std::vector<physics::BodyState> states(asset.profile.bodies.size());
    std::vector<RigidTransform> wanted(states.size()), bodies(states.size());
    std::vector<float> errors(asset.profile.constraints.size());
    for (int frame = 0; frame < clip.frameCount; ++frame) {
        const std::span<const RigidTransform> local =
            std::span(clip.parentFromJoint.get()).subspan(static_cast<std::size_t>(frame) * joints, joints);
        animation::localToModel(skeleton, local, model);
        physics::bodiesFromPose(asset.rig, model, {}, states);
        for (std::size_t i = 0; i < states.size(); ++i)
            wanted[i] = bodies[i] = states[i].worldFromBody;
        reachable.apply(bodies);
        physics::jointErrors(asset.profile, wanted, bodies, errors);
        for (std::size_t i = 0; i < errors.size(); ++i) {
            if (degrees(errors[i]) <= out.mostDeg) continue;
            out.mostDeg = degrees(errors[i]);
            out.joint = asset.profile.bodies[asset.profile.constraints[i].child].name;
        }
        physics::poseFromBodies(asset.rig, skeleton, bodies, {}, model, local);
        animation::modelToLocal(skeleton, model, pose);
        out.clip.parentFromJoint.append(pose);
    }
    return out;
}

}  // namespace lutka::scene
