#pragma once

#include <span>
#include <string>
#include <vector>

#include "animation/character.hpp"
#include "animation/humanoid/map_humanoid.hpp"
#include "core/result.hpp"
#include "physics/fit/fit_measures.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::physics {

enum class Severity { info, warning, error };
[[nodiscard]] const char* severityName(Severity severity);

/// What the ragdoll doctor found wrong, or worth knowing.
struct Finding {
    Severity severity = Severity::warning;
    std::string code;                 ///< Which check, one of those listed at diagnose().
    std::string place;                ///< Body or bodies, or a JSON pointer into the profile.
    std::string measure;              ///< The figure and the bound that it breaks, in words.
    std::string mend;                 ///< What to do about it.
    bool mendable = false;            ///< applyMends() does it.
    std::vector<std::string> bodies;  ///< Those concerned, by name; a constraint is told by its child.
};

/// A part of the score: `points` out of `of`.
struct ScorePart {
    std::string name;
    float points = 0.0F;
    float of = 0.0F;
};

struct Diagnosis {
    std::vector<Finding> findings;  ///< Errors first, then warnings, then notes.
    FitMeasures fit;
    float score = 0.0F;  ///< [0, 100]: the parts' points over what they could be.
    std::vector<ScorePart> parts;

    [[nodiscard]] bool hasErrors() const;
};

/// Examines a profile at rest on its character. A figure that is broken as a whole (hardly half a body, a limb's joint
/// on another limb, skin elsewhere or on one joint, bodies beside their skin) scores 40 at most. The checks, by code:
/// - `profile-invalid` what validate() says; nothing else is looked at (error)
/// - `joint-missing` a body's joint is not in the skeleton; nothing else is looked at (error)
/// - `role-unmapped` a required role has no joint (warning: the ragdoll has fewer bodies)
/// - `roles-few` fewer than half of the required roles have a joint, and head or a whole limb has none (error)
/// - `joint-not-below` a role's joint is not below that of the role above it, or hangs on another limb (error; warning
///   where both sides are built so, as feet under an IK root, and in a flat tree)
/// - `limb-uneven` one half of an arm or leg is more than three times as long as the other: a role is on a joint
///   farther out or in (warning)
/// - `skin-outside-bodies` most of the skin is more than 6 % of the height (of a thick body: 74 % of its radius) from
///   all bodies, and few of these have skin of their own about them; or much of it lies at bodies of other parts than
///   the one that moves it (error)
/// - `skin-of-others` three parts or more of a figure whose skin mostly follows parts that they are not linked with
///   (error)
/// - `skin-on-one-joint` nine tenths of the skin follow one joint where there are many bodies (error)
/// - `skin-small` most bodies' skin is less than 45 % as long as they are: another unit (error)
/// - `body-beside-skin` a body lies beside all the skin that follows it and hardly touches any (error)
/// - `body-in-the-air` a body that moves no skin is where there is none, nor another body (warning; the score is 90 at
///   most)
/// - `mass-ratio` above 10 : 1 across a constraint (warning; above 20 : 1 error)
/// - `bind-outside-limits` a limit excludes the bind pose: energy appears at the first step (error)
/// - `limit-impossible` a limit more than 230 degrees from the bind pose (error)
/// - `limit-span-small` a span below 5 degrees either way, known to jitter (warning)
/// - `hinge-reversed` a knee or elbow that would bend the wrong way (error)
/// - `hinge-askew` a hinge axis more than 45 degrees off the anatomy's (warning)
/// - `overlap` bodies that overlap in the bind pose though they may collide (error from 1 % of the height)
/// - `capsule-outside-skin` a body that stands out of its skin by more than 2 % of the height at over a quarter of it
/// - `skin-not-covered` a body more than 4 % of the height below its skin at over a quarter of it (both warnings;
///   mendable where another fit is without them)
/// - `sides-differ` shape or mass of left and right differ by more than a tenth on a symmetric rig (warning)
/// - `body-tiny`, `body-huge` radius below 0.8 % of the height, or above what any fit gives (warning)
/// - `chain-degenerate` two linked joints nearer than 0.5 % of the height (warning)
/// - `not-humanoid` which of these checks do not apply to a ragdoll without roles: role-unmapped, roles-few,
///   joint-not-below, limb-uneven, hinge-reversed and hinge-askew (info)
/// - `note` what the fit had to bend (info)
[[nodiscard]] Diagnosis diagnose(const RagdollProfile& profile, const animation::Character& character,
                                 const animation::HumanoidMap& map);

/// The profile with the mendable findings mended (limits widened, pairs filtered, hinge frames and shapes made anew,
/// masses balanced, sides made equal), and a sentence a mend in its notes. Fails with ErrorCode::input when the profile
/// is invalid or does not belong to the character.
[[nodiscard]] Result<RagdollProfile> applyMends(const RagdollProfile& profile, const animation::Character& character,
                                                const animation::HumanoidMap& map, std::span<const Finding> findings);

}  // namespace lutka::physics
