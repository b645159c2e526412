#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "animation/humanoid/parts.hpp"

namespace lutka::animation {

/// A part's score from which a name says that a joint is this part: of a limb …
inline constexpr float kTellsPartOfLimb = 1.5F;
/// … and of the trunk, from the hips to the head.
inline constexpr float kTellsTrunkEnd = 2.0F;

/// … surely this one and no other.
inline constexpr float kTellsSurely = 4.0F;

/// What a joint's name says.
struct NameEvidence {
    /// Log-likelihood ratio of the name under each part against none: about +4.5 for a clear word, 1 to 2 for a word
    /// whose meaning differs between rigs ("shoulder", "leg"), 0 for a name that says nothing, negative for another
    /// part's.
    PartScores parts;
    Side side = Side::center;
    bool meaningful = false;    ///< Some word of the name is in the lexicon.
    PartScores partsIfSkinned;  ///< As parts, where the name says control but the joint moves skin of its own.
    bool control = false;       ///< Takes no role only because the name says control ("FootIK.L").
    bool helper = false;        ///< Twist, control, tip, prop: sits at a body part without being it.
    bool bareLimb = false;      ///< Only "arm" or "leg", without a word for which part of it.
    bool face = false;          ///< Eye, jaw, nose …: in front of the head.
    bool finger = false;        ///< Any of the hand's, thumbs and their palms among them.
    bool thumb = false;
    bool held = false;    ///< Weapon, shield, prop, and what hangs on one: no part of the body.
    bool worn = false;    ///< Cloth or hair: no part of the body.
    bool onBack = false;  ///< What figures carry on their backs: capes, packs, wings.
    bool tail = false;
    bool creature = false;           ///< Wing, paw, front leg …: not a human part.
    std::vector<std::string> words;  ///< For reasons and for pairing left and right.
    std::vector<int> numbers;        ///< As in NameTokens.
};

[[nodiscard]] NameEvidence nameEvidence(std::string_view name);

/// Whether a joint is named like the one above it, or with words more that say nothing: "forearm_seg" below "forearm".
[[nodiscard]] bool isSecondSegment(const NameEvidence& above, const NameEvidence& name);

}  // namespace lutka::animation
