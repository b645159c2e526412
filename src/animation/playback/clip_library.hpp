#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "animation/clip.hpp"
#include "animation/playback/root_motion.hpp"
#include "core/result.hpp"

namespace lutka::animation {

/// A moment of a clip that is told when playback passes it: a footstep, a grasp.
struct ClipEvent {
    float seconds = 0.0F;  ///< [0, the clip's length]
    std::string name;
};

/// Clips of one skeleton made ready for playing: all frames in one block, the way of the root beside them. Shared by
/// all players and crowds; immutable but for events.
class ClipLibrary {
  public:
    /// Copies the frames of the clips (and fills those that were not sampled yet). Fails with ErrorCode::input when a
    /// clip has another number of joints, no frames, a rate that is no positive number, or a frame that is not finite.
    [[nodiscard]] static Result<ClipLibrary> create(const Skeleton& skeleton, std::span<const Clip> clips,
                                                    const RootMotionSettings& root = {});

    [[nodiscard]] int clipCount() const { return static_cast<int>(clips_.size()); }
    [[nodiscard]] int jointCount() const { return skeleton_.jointCount(); }
    [[nodiscard]] const Skeleton& skeleton() const { return skeleton_; }
    [[nodiscard]] const RootMotionSettings& root() const { return root_; }
    /// The first clip of that name; -1: none.
    [[nodiscard]] int find(std::string_view name) const;
    [[nodiscard]] const std::string& name(int clip) const { return clips_[clip].name; }
    [[nodiscard]] float seconds(int clip) const { return clips_[clip].seconds; }

    /// The bind pose, parent-relative: what stands where nothing plays.
    [[nodiscard]] std::span<const RigidTransform> restPose() const { return rest_; }
    [[nodiscard]] std::span<const RigidTransform> firstFrame(int clip) const;
    /// sampleClip() of the clip at `seconds` (clamped), parent-relative, into jointCount() frames.
    void sample(int clip, float seconds, std::span<RigidTransform> parentFromJoint) const;
    /// The same without its travel: the figure stands over the model's origin; see groundFrame().
    void sampleInPlace(int clip, float seconds, std::span<RigidTransform> parentFromJoint) const;
    /// modelFromGround at `seconds` (clamped): sample() is this times sampleInPlace() for every joint without a parent.
    [[nodiscard]] RigidTransform groundFrame(int clip, float seconds) const;

    /// Fails with ErrorCode::usage when the moment lies outside of the clip. Events are kept sorted by time.
    [[nodiscard]] Result<void> addEvent(int clip, ClipEvent event);
    [[nodiscard]] std::span<const ClipEvent> events(int clip) const { return clips_[clip].events; }

    /// Two frames and how far between them a moment lies.
    struct Moment {
        std::size_t before = 0;  ///< Index into frames() of the pose's first joint.
        std::size_t after = 0;
        float alpha = 0.0F;      ///< [0, 1) from before to after.
        float heldAlpha = 0.0F;  ///< 0 or 1: which of them joints show that hold their frames.
    };
    [[nodiscard]] Moment momentOf(int clip, float seconds) const;
    /// A joint between the frames of a moment; `held`: its byte of steppedJoints().
    [[nodiscard]] RigidTransform jointAt(const Moment& moment, std::size_t joint, unsigned char held) const;
    /// All clips' poses, one after the other, jointCount() frames each.
    [[nodiscard]] std::span<const RigidTransform> frames() const { return frames_; }
    /// A byte a clip and joint: wide::kHeldTurn and wide::kHeldPlace where its rotation or translation holds its
    /// frames; empty where none does.
    [[nodiscard]] std::span<const unsigned char> steppedJoints() const { return stepped_; }
    /// Joints without a parent.
    [[nodiscard]] std::span<const int> rootJoints() const { return rootJoints_; }

  private:
    struct Entry {
        std::string name;
        float framesPerSecond = 30.0F;
        float seconds = 0.0F;
        int frameCount = 1;
        std::size_t firstPose = 0;  // of frames_ in poses, and of ground_
        std::vector<ClipEvent> events;
    };
    explicit ClipLibrary(const Skeleton& skeleton, const RootMotionSettings& root);
    void add(const Clip& clip);

    Skeleton skeleton_;
    RootMotionSettings root_;
    std::vector<RigidTransform> rest_;
    std::vector<int> rootJoints_;
    std::vector<Entry> clips_;
    std::vector<RigidTransform> frames_;
    std::vector<RigidTransform> ground_;  // one a pose
    std::vector<unsigned char> stepped_;
};

}  // namespace lutka::animation
