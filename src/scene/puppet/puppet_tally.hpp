#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scene/asset/ragdoll_asset.hpp"

namespace lutka::scene {

/// Of dolls that got up.
struct GetUpFigures {
    int begun = 0;
    int stood = 0;             ///< How often one came to stand again.
    float mostSeconds = 0.0F;  ///< From coming to rest until it stood.
    float meanSeconds = 0.0F;
    float mostStepDeg = 0.0F;    ///< That a joint turned by in one step on the way.
    std::string stepJoint;       ///< The body below it.
    float mostSlideM = 0.0F;     ///< Of a foot that stood flat in the pose, from where it came to stand.
    float meanDistanceM = 0.0F;  ///< Of the pose lain in from the frame that it went on from.
};

/// How far one joint was from the pose's angle.
struct JointFigures {
    std::string name;  ///< Of the body below it.
    float rmsDeg = 0.0F;
    float maxDeg = 0.0F;
};

/// How well the dolls kept to their poses, over all of them and all steps in which they were not limp.
struct PuppetFigures {
    float rmsDeg = 0.0F;  ///< Of all joints' angles from the pose's.
    float maxDeg = 0.0F;
    std::string worstJoint;            ///< The body below the joint of `maxDeg`.
    std::vector<JointFigures> joints;  ///< Each of them, over all characters that have a body of that name.
    float clipReachDeg = 0.0F;         ///< Most that a joint of the clip was turned by, so that the doll can follow it.
    std::string clipReachJoint;        ///< The body below it.
    float rootM = 0.0F;                ///< Farthest that a pinned root body was from its pose.
    float ledM = 0.0F;                 ///< And any kinematic body.
    /// On ground that is not level, of feet that stand in the clip: the mean and the most that they were above it, and
    /// the deepest in it.
    float footGapMeanM = 0.0F;
    float footGapM = 0.0F;
    float footDepthM = 0.0F;
    float footSlideM = 0.0F;        ///< Farthest that a foot which stands flat in the pose slid while it stood.
    int limp = 0;                   ///< Dolls that are limp now.
    int knockOuts = 0;              ///< How often any became so.
    float recoverySeconds = -1.0F;  ///< The longest time from a hit until its doll was animated again; -1: none was.
};

/// Adds up, step for step, how well the dolls of a cast keep to their poses.
class TrackingTally {
  public:
    /// The assets must outlive the tally.
    explicit TrackingTally(std::span<const RagdollAsset* const> assets);

    /// A doll's joints after a step: how far they are from the pose's angles, radians, one a constraint.
    void addJoints(int asset, std::span<const float> errors);
    /// How far a root body, and a kinematic body, is from its pose, metres.
    void addRoot(float distanceM);
    void addLed(float distanceM);
    /// How far a foot that stands in the clip is over the ground, metres; below 0: in it.
    void addFooting(float heightM);
    /// How far a foot that stands flat has slid from where it came to stand, metres.
    void addSlide(float distanceM);
    void addKnockOut() { ++worst_.knockOuts; }
    /// Seconds from a hit until the doll was animated again.
    void addRecovery(float seconds);

    /// All but the clip's reach and how many are limp now.
    [[nodiscard]] PuppetFigures figures() const;

  private:
    // A joint's angles from the pose's, degrees.
    struct JointTally {
        double squares = 0.0;
        long long count = 0;
        float maxDeg = 0.0F;
        void add(const JointTally& other);
        [[nodiscard]] float rmsDeg() const;
    };
    [[nodiscard]] std::vector<std::pair<std::string, JointTally>> jointTallies() const;

    std::vector<const RagdollAsset*> assets_;
    std::vector<std::vector<JointTally>> tallies_;  // one an asset, of a tally a constraint
    double gapsM_ = 0.0;
    long long standing_ = 0;  // feet, in all steps
    PuppetFigures worst_;
};

/// Adds up how dolls get up.
class GetUpTally {
  public:
    /// One begins, from a frame so far from the pose lain in.
    void begin(float distanceM);
    /// One stands, so long after it came to rest.
    void stand(float seconds);
    /// A joint above that body turned by so much in a step on the way.
    void turn(float stepDeg, const std::string& body);
    /// A foot that stands flat on the way has slid by so much.
    void slide(float distanceM);

    [[nodiscard]] GetUpFigures figures() const;

  private:
    GetUpFigures figures_;
    double seconds_ = 0.0;
    double matchedM_ = 0.0;
};

}  // namespace lutka::scene
