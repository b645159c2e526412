#pragma once

#include <cmath>
#include <cstddef>

#include "animation/humanoid/evidence_terms.hpp"
#include "animation/humanoid/name_evidence.hpp"

namespace lutka::animation {

/// One measure of a limb, what it is in a human figure and how much it may speak against a reading.
struct LimbTerm {
    float mean;       ///< Of a human figure; for bounds the last value that costs nothing.
    float deviation;  ///< Standard deviation beyond the mean or the bound.
    float floor;      ///< The most that it may cost, in log-odds.
    const char* why;  ///< The measure in words.

    [[nodiscard]] float near(float value, float slack = 1.0F) const {
        return animation::near(value, mean, deviation * slack, floor);
    }
    [[nodiscard]] float atMost(float value) const { return animation::atMost(value, mean, deviation, floor); }
    [[nodiscard]] float atLeast(float value) const { return animation::atLeast(value, mean, deviation, floor); }
};

/// The measures of legs and arms. Lengths are shares of the limb's length where nothing else is said.
namespace limb_terms {

inline constexpr LimbTerm kStraightTwist{0.0F, 0.06F, 2.0F, "a skipped joint's distance from the line, of the line"};

inline constexpr LimbTerm kLegDown{0.97F, 0.12F, 6.0F, "cosine of the whole leg to straight down, at least"};
inline constexpr LimbTerm kThighDown{0.7F, 0.25F, 6.0F, "cosine of the thigh to straight down, at least"};
inline constexpr LimbTerm kShinDown{0.88F, 0.08F, 6.0F, "cosine of the shin to straight down, at least"};
inline constexpr LimbTerm kThighAside{0.2F, 0.2F, 2.0F, "the thigh's distance from the mirror plane"};
inline constexpr LimbTerm kAnkleHeight{0.1F, 0.18F, 5.0F, "the ankle's height, of the way from the floor to the hip"};
inline constexpr LimbTerm kSkinEndHeight{0.0F, 0.18F, 5.0F, "as the ankle's, of the end of the skin"};
inline constexpr LimbTerm kThighToShin{0.05F, 0.3F, 6.0F, "log ratio of thigh to shin"};
inline constexpr LimbTerm kThighToRest{0.0F, 0.45F, 4.0F, "log ratio of thigh to the rest, where no ankle is"};
inline constexpr LimbTerm kToeDistance{0.18F, 0.2F, 3.0F, "toes to ankle, of the hip's height"};
inline constexpr LimbTerm kToesSideways{0.3F, 0.25F, 3.0F, "sideways share of the way to the toes, at most"};

inline constexpr LimbTerm kArmOut{0.0F, 0.15F, 6.0F, "the arm's direction away from the mirror plane, at least"};
inline constexpr LimbTerm kArmRaised{0.3F, 0.3F, 3.0F, "the arm's direction upwards, at most"};
inline constexpr LimbTerm kUpperToFore{0.08F, 0.28F, 3.0F, "log ratio of upper arm to forearm"};
inline constexpr LimbTerm kUpperToRest{-0.1F, 0.45F, 4.0F, "log ratio of upper arm to the rest, where no hand is"};
inline constexpr LimbTerm kElbowStraight{0.75F, 0.3F, 6.0F, "cosine of upper arm to forearm, at least"};
inline constexpr LimbTerm kBeyondHand{0.3F, 0.22F, 4.0F, "how far joints go on beyond the hand"};
inline constexpr LimbTerm kShoulderAside{0.33F, 0.14F, 3.0F, "the upper arm's distance from the mirror plane"};
inline constexpr LimbTerm kClavicleLength{0.28F, 0.13F, 4.0F, "clavicle to upper arm"};
inline constexpr LimbTerm kClavicleAside{0.08F, 0.12F, 3.0F, "the clavicle's distance from the mirror plane"};

}  // namespace limb_terms

/// What a reading of a limb gains or loses besides its measures, in log-odds.
namespace limb_costs {

// A limb that lacks joints is the less likely reading of a chain that has them.
inline constexpr float kMissingEnd = -2.5F;
inline constexpr float kMissingMiddle = -2.5F;
inline constexpr float kJoint = 1.0F;  // gained for each joint that has a place
inline constexpr float kToes = 1.6F;
inline constexpr float kClavicle = 1.0F;
inline constexpr float kNoOwnSkin = -1.2F;
inline constexpr float kNoSkinBelow = -2.5F;
inline constexpr float kDetached = -1.5F;          // the next joint is not below this one in the tree
inline constexpr float kDetachedFromMore = -6.0F;  // … though the limb has joints to go on with
inline constexpr float kImpossible = -100.0F;
inline constexpr float kShadow = -3.0F;
inline constexpr float kMainBranch = 0.7F;        // times the log share of the skin that goes on that way
inline constexpr float kLeastMainBranch = -4.0F;  // … before that factor
inline constexpr float kInMiddle = -3.5F;         // thighs and upper arms never start in the mirror plane
inline constexpr float kSecondSegment = -4.0F;    // named like the joint above it: "upper_arm.L.001"
inline constexpr float kSkippedJoint = -0.4F;     // a skinned joint between two placed ones: twist, or a second segment
inline constexpr float kUnusedAbove = -0.8F;      // a skinned pair above the limb without a place
inline constexpr float kLeftOverAfterTwo = -1.0F;  // a limb that is read as shorter than its chain
inline constexpr float kLeftOverAfterOne = -4.0F;
inline constexpr float kNothingBeyondHand = -0.3F;
inline constexpr float kNamedPose = -3.0F;         // the most that the pose of a limb with clear names may cost
inline constexpr float kNamedProportions = -1.5F;  // … and its proportions
inline constexpr float kDetachedNamed = -0.2F;     // as kDetached, where the names say which joints follow each other
inline constexpr float kNoDirection = -1.0F;       // joints of one place

}  // namespace limb_costs

/// Bounds and sizes of the search for limbs.
namespace limb_bounds {

inline constexpr float kShortestSegment = 0.02F;  // of the spread
inline constexpr float kShortestLimb = 3.0F;      // segments of that length
inline constexpr float kLeastRatio = 0.2F;        // of a segment to the next
inline constexpr float kMostRatio = 5.0F;
inline constexpr float kMiddle = 0.03F;         // of the limb's length: nearer joints lie in the mirror plane
inline constexpr float kLeastHipHeight = 0.3F;  // of the leg's length: heights are never shares of less
inline constexpr float kShortestToes = 0.03F;   // of the hip's height
inline constexpr float kHighestToes = 0.04F;    // above the ankle
inline constexpr float kShortestClavicle = 0.04F;
// Where any pair may follow any other, time grows with the cube: beyond these many only those whose names say a part of
// the limb, and then none.
inline constexpr std::size_t kMostPairsDetached = 48;
inline constexpr std::size_t kMostPairsNamedDetached = 120;
inline constexpr std::size_t kPerRoot = 3;
inline constexpr std::size_t kHeldPerRoot = 64;  // before they are thinned to kPerRoot
inline constexpr std::size_t kMost = 48;
inline constexpr int kMostSkipped = 24;  // skinned joints between two placed ones: no limb beyond, and no search either
inline constexpr float kSlackOfOneJoint = 3.0F;  // a limb of one joint may start anywhere along it
inline constexpr float kNamedPart =
    kTellsPartOfLimb;                                // a name's score from which it says which part of the limb this is
inline constexpr float kSurelyNamed = kTellsSurely;  // … and from which it says nothing else
inline constexpr float kEndWordLead = 2.0F;  // by how much a name must speak for the hand or foot to make it one

}  // namespace limb_bounds

}  // namespace lutka::animation
