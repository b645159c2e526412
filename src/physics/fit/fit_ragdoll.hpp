#pragma once

#include "animation/character.hpp"
#include "animation/humanoid/map_humanoid.hpp"
#include "core/result.hpp"
#include "physics/fit/fit_options.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// A whole ragdoll from a mapped character: bodies from the skin each joint owns (from joint distances where there is
/// no skin), masses, anatomical limits, collision filter. The bind pose lies inside all limits.
/// With options.rig any the bodies are those of segmentRig(), masses go by volume, limits by what each segment is
/// (setSegmentRange()), and of the map only standardFromModel counts, which must be segmentRig()'s.
/// Fails with ErrorCode::input when the map is not a humanoid's, or any rig has no joint.
[[nodiscard]] Result<RagdollProfile> fitRagdoll(const animation::Character& character,
                                                const animation::HumanoidMap& map, const FitOptions& options = {});

}  // namespace lutka::physics
