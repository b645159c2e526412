#include "scene/reachable_clip.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "animation/pose.hpp"
#include "animation/retarget/anatomical_rig.hpp"
#include "physics/powered/pose_drive.hpp"
#include "physics/powered/reachable_pose.hpp"

namespace lutka::scene {
namespace {

constexpr float kStandingShare = 0.25F;  // of the frames, in which a clip stands most lightly

// Frames of a clip as bodies over level ground.
class ClipBodies {
  public:
    ClipBodies(const RagdollAsset& asset, const animation::Clip& clip, std::vector<bool> keeps)
        : asset_(asset),
          clip_(clip),
          reachable_(asset.profile, std::move(keeps)),
          standing_{asset.map.standardFromModel, vec3(0, -animation::floorOf(asset.character, asset.map), 0)},
          model_(asset.character.skeleton.parents.size()),
          pose_(model_.size()),
          states_(asset.profile.bodies.size()),
          wanted_(states_.size()),
          bodies_(states_.size()) {}

    [[nodiscard]] std::span<const RigidTransform> wanted() const { return wanted_; }
    [[nodiscard]] std::span<RigidTransform> bodies() { return bodies_; }

    // As the clip has it, and as the doll can take it.
    void read(int frame) {
        animation::localToModel(asset_.character.skeleton, localOf(frame), model_);
        physics::bodiesFromPose(asset_.rig, model_, standing_, states_);
        for (std::size_t i = 0; i < states_.size(); ++i)
            wanted_[i] = bodies_[i] = states_[i].worldFromBody;
        reachable_.apply(bodies_);
    }
    // Local to the joints.
    [[nodiscard]] std::span<const RigidTransform> pose(int frame) {
        const animation::Skeleton& skeleton = asset_.character.skeleton;
        physics::poseFromBodies(asset_.rig, skeleton, bodies_, standing_, model_, localOf(frame));
        animation::modelToLocal(skeleton, model_, pose_);
        return pose_;
    }
    // How deep the clip is in the ground while it stands: a figure with thick soles is so throughout. A leg that is
    // lifted out by its knee no longer stands as it does, so that this lifts the whole figure.
    [[nodiscard]] float depth(const FloorKeeper& floor) {
        std::vector<float> depths;
        for (int frame = 0; frame < clip_.frameCount; ++frame) {
            read(frame);
            float lowest = 1e9F;
            for (std::size_t i = 0; i < bodies_.size(); ++i)
                lowest = std::min(lowest, floor.lowestOf(static_cast<int>(i), bodies_[i]));
            depths.push_back(-lowest);
        }
        if (depths.empty()) return 0.0F;
        const auto at = depths.begin() + static_cast<int>(kStandingShare * static_cast<float>(depths.size()));
        std::nth_element(depths.begin(), at, depths.end());
        return std::max(*at, 0.0F);
    }

  private:
    [[nodiscard]] std::span<const RigidTransform> localOf(int frame) const {
        return std::span(clip_.parentFromJoint.get())
            .subspan(static_cast<std::size_t>(frame) * model_.size(), model_.size());
    }

    const RagdollAsset& asset_;
    const animation::Clip& clip_;
    physics::ReachablePose reachable_;
    RigidTransform standing_;
    std::vector<RigidTransform> model_, pose_;
    std::vector<physics::BodyState> states_;
    std::vector<RigidTransform> wanted_, bodies_;
};

}  // namespace

ReachableClip reachableClip(const RagdollAsset& asset, const animation::Clip& clip, std::vector<bool> keeps,
                            const FloorKeeper* floor) {
    ClipBodies frames(asset, clip, std::move(keeps));
    ReachableClip out;
    out.clip = clip;
    out.clip.parentFromJoint = {};
    const float depth = floor != nullptr ? frames.depth(*floor) : 0.0F;
    std::vector<float> errors(asset.profile.constraints.size());
    for (int frame = 0; frame < clip.frameCount; ++frame) {
        frames.read(frame);
        if (floor != nullptr) {
            for (RigidTransform& body : frames.bodies())
                body.translation.y += depth;
            floor->keep([](const vec3&) { return 0.0F; }, frames.bodies());
        }
        physics::jointErrors(asset.profile, frames.wanted(), frames.bodies(), errors);
        for (std::size_t i = 0; i < errors.size(); ++i) {
            if (degrees(errors[i]) <= out.mostDeg) continue;
            out.mostDeg = degrees(errors[i]);
            out.joint = asset.profile.bodies[asset.profile.constraints[i].child].name;
        }
        out.clip.parentFromJoint.append(frames.pose(frame));
    }
    return out;
}

}  // namespace lutka::scene
