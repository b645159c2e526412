#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "animation/clip.hpp"
#include "core/result.hpp"
#include "physics/profile/body_state.hpp"
#include "scene/asset/ragdoll_asset.hpp"

namespace lutka::scene {

/// On what a figure lies.
enum class Lying { prone, supine, leftSide, rightSide };
[[nodiscard]] std::string_view lyingName(Lying lying);
/// By where the front of the body with the most mass of hips and chest looks; `worldFromBody` is one a body.
[[nodiscard]] Lying lyingOf(const RagdollAsset& asset, std::span<const RigidTransform> worldFromBody);

/// The character's own clip that is called so, `exactly` or as animation::clipMeant() understands it; -1: none.
[[nodiscard]] int ownClip(const RagdollAsset& asset, std::string_view name, bool exactly);
/// The clip of that name: the character's own, else the donor's retargeted. Fails with ErrorCode::usage when neither
/// has it, or as retargetClip() does.
[[nodiscard]] Result<animation::Clip> clipOf(const RagdollAsset& asset, const RagdollAsset* donor,
                                             std::string_view name, bool exactly = false);

/// The ways of a character from lying to standing, and which of them begins most like a pose.
class GetUpClips {
  public:
    /// The character's own get-up clips, else those of the donor, retargeted. A get-up clip has "get up" or "stand up"
    /// in its name, with or without something between the words, and its hips begin below half the height at which they
    /// end. Fails with ErrorCode::input when there are none at all. The asset must outlive this.
    [[nodiscard]] static Result<GetUpClips> create(const RagdollAsset& asset, const RagdollAsset* donor);
    /// Whether the character has such clips itself.
    [[nodiscard]] static bool hasOwn(const RagdollAsset& asset);

    /// A moment of a clip and where to play it.
    struct Match {
        int clip = 0;
        float seconds = 0.0F;
        RigidTransform worldFromStandard;  ///< Of the clip's ground: turned about the vertical, at `ground`.
        float distanceM = 0.0F;            ///< Root of the mean square, by mass, between points on the bodies.
    };
    /// The frame from which the figure can go on with the least change, of those in which the hips are still low.
    /// Frames are turned about the vertical and shifted over ground at the height `ground`, so that the points on their
    /// bodies come nearest to the doll's; the nearest frame wins (the distance of point clouds: Kovar, Gleicher and
    /// Pighin 2002, "Motion Graphs").
    [[nodiscard]] Match match(std::span<const RigidTransform> worldFromBody, float ground) const;

    [[nodiscard]] int clipCount() const { return static_cast<int>(clips_.size()); }
    [[nodiscard]] const std::string& name(int clip) const { return clips_[clip].name; }
    [[nodiscard]] float seconds(int clip) const { return clips_[clip].seconds(); }
    /// The bodies at a moment (clamped), world, one a body of the profile.
    void sample(const Match& match, float seconds, std::span<RigidTransform> worldFromBody);

  private:
    struct Frame {
        int clip = 0;
        float seconds = 0.0F;
        std::vector<vec3> points;  // standard space, kPointsOfBody a body
    };
    explicit GetUpClips(const RagdollAsset& asset);
    void addFrames(int clip);
    [[nodiscard]] std::vector<vec3> pointsOf(std::span<const RigidTransform> bodies) const;

    const RagdollAsset* asset_;
    float floor_ = 0.0F;  // what the figure stands on in its bind pose, standard space
    std::vector<animation::Clip> clips_;
    std::vector<Frame> frames_;
    std::vector<RigidTransform> joints_;  // scratch
    std::vector<physics::BodyState> bodies_;
};

}  // namespace lutka::scene
