#include "scene/puppet/reachable_clip.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "animation/pose.hpp"
#include "physics/powered/pose_drive.hpp"
#include "physics/powered/reachable_pose.hpp"
#include "physics/profile/within_limits.hpp"

namespace lutka::scene {
namespace {

constexpr float kJump = radians(240.0F);  // a second: a correction that turns faster than this
constexpr float kSpreadSeconds = 0.1F;    // is spread over so long before and after
constexpr float kStandingShare = 0.25F;   // of the frames, in which a clip stands most lightly

// Frames of a clip as bodies over level ground.
class ClipBodies {
  public:
    ClipBodies(const RagdollAsset& asset, const animation::Clip& clip, std::vector<bool> keeps)
        : asset_(asset),
          clip_(clip),
          keeps_(std::move(keeps)),
          reachable_(asset.profile, keeps_),
          standing_{asset.map.standardFromModel, vec3(0, -standingFloorOf(asset), 0)},
          model_(asset.character.skeleton.parents.size()),
          pose_(model_.size()),
          states_(asset.profile.bodies.size()),
          wanted_(states_.size()),
          bodies_(states_.size()),
          joints_(asset.profile.constraints.size()) {
        correct();
    }

    [[nodiscard]] std::span<const RigidTransform> wanted() const { return wanted_; }
    [[nodiscard]] std::span<RigidTransform> bodies() { return bodies_; }

    // As the clip has it, and as the doll can take it.
    void read(int frame) {
        readWanted(frame);
        for (std::size_t joint = 0; joint < joints_; ++joint)
            turnJoint(joint, corrections_[static_cast<std::size_t>(frame) * joints_ + joint]);
        reachable_.closeJoints(bodies_);
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
    // What makes each frame reachable, joint by joint. A limb that the clip leads through a body leaves it on another
    // side from one frame to the next: what jumps so is spread over the frames around.
    void correct() {
        corrections_.reserve(static_cast<std::size_t>(clip_.frameCount) * joints_);
        for (int frame = 0; frame < clip_.frameCount; ++frame) {
            readWanted(frame);
            reachable_.apply(bodies_);
            for (std::size_t joint = 0; joint < joints_; ++joint)
                corrections_.push_back(relative(bodies_, joint) * glm::conjugate(relative(wanted_, joint)));
        }
        const int spread = static_cast<int>(std::lround(kSpreadSeconds * clip_.framesPerSecond));
        for (std::size_t joint = 0; joint < joints_ && spread > 0; ++joint)
            if (jumps(joint)) spreadOut(joint, spread);
    }
    void readWanted(int frame) {
        animation::localToModel(asset_.character.skeleton, localOf(frame), model_);
        physics::bodiesFromPose(asset_.rig, model_, standing_, states_);
        for (std::size_t i = 0; i < states_.size(); ++i)
            wanted_[i] = bodies_[i] = states_[i].worldFromBody;
    }
    // The child's turn in its parent.
    [[nodiscard]] quat relative(std::span<const RigidTransform> bodies, std::size_t joint) const {
        const physics::ConstraintProfile& constraint = asset_.profile.constraints[joint];
        return glm::conjugate(bodies[constraint.parent].rotation) * bodies[constraint.child].rotation;
    }
    void turnJoint(std::size_t joint, const quat& correction) {
        const physics::ConstraintProfile& constraint = asset_.profile.constraints[joint];
        quat turn = relative(wanted_, joint);
        // What is spread is out of the limits where it is another frame's.
        const bool isKept = !keeps_.empty() && keeps_[static_cast<std::size_t>(constraint.child)];
        if (!isKept) turn = physics::withinLimits(constraint, correction * turn);
        bodies_[constraint.child].rotation = glm::normalize(bodies_[constraint.parent].rotation * turn);
    }
    [[nodiscard]] const quat& correctionOf(int frame, std::size_t joint) const {
        return corrections_[static_cast<std::size_t>(std::clamp(frame, 0, clip_.frameCount - 1)) * joints_ + joint];
    }
    [[nodiscard]] bool jumps(std::size_t joint) const {
        for (int frame = 1; frame < clip_.frameCount; ++frame) {
            const quat step = correctionOf(frame, joint) * glm::conjugate(correctionOf(frame - 1, joint));
            if (glm::length(rotationVector(glm::normalize(step))) * clip_.framesPerSecond > kJump) return true;
        }
        return false;
    }
    // The farthest of those around, and of these the mean over a triangle: where a limb is turned out of something it
    // stays out of it.
    void spreadOut(std::size_t joint, int spread) {
        const auto angleOf = [&](int frame) { return glm::length(rotationVector(correctionOf(frame, joint))); };
        std::vector<quat> farthest;
        for (int frame = 0; frame < clip_.frameCount; ++frame) {
            int most = frame;
            for (int other = frame - spread; other <= frame + spread; ++other)
                if (angleOf(other) > angleOf(most)) most = other;
            farthest.push_back(correctionOf(most, joint));
        }
        replace(joint, farthest);
        std::vector<quat> means;
        for (int frame = 0; frame < clip_.frameCount; ++frame) {
            const quat middle = correctionOf(frame, joint);
            vec3 turn(0);
            float weights = 0.0F;
            for (int by = -spread; by <= spread; ++by) {
                const auto weight = static_cast<float>(spread + 1 - std::abs(by));
                turn +=
                    weight * rotationVector(glm::normalize(correctionOf(frame + by, joint) * glm::conjugate(middle)));
                weights += weight;
            }
            turn /= weights;
            const float angle = glm::length(turn);
            means.push_back(angle > 1e-6F ? glm::normalize(glm::angleAxis(angle, turn / angle) * middle) : middle);
        }
        replace(joint, means);
    }
    void replace(std::size_t joint, std::span<const quat> corrections) {
        for (std::size_t frame = 0; frame < corrections.size(); ++frame)
            corrections_[frame * joints_ + joint] = corrections[frame];
    }
    [[nodiscard]] std::span<const RigidTransform> localOf(int frame) const {
        return std::span(clip_.parentFromJoint.get())
            .subspan(static_cast<std::size_t>(frame) * model_.size(), model_.size());
    }

    const RagdollAsset& asset_;
    const animation::Clip& clip_;
    std::vector<bool> keeps_;
    physics::ReachablePose reachable_;
    RigidTransform standing_;
    std::vector<RigidTransform> model_, pose_;
    std::vector<physics::BodyState> states_;
    std::vector<RigidTransform> wanted_, bodies_;
    std::size_t joints_;
    std::vector<quat> corrections_;  // frame by frame, one a joint: left of its turn in its parent
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
            floor->keep([](const vec3&) { return 0.0F; }, frames.bodies(), floor->swings());
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
