#pragma once

#include "animation/character.hpp"
#include "animation/humanoid/map_humanoid.hpp"
#include "core/result.hpp"
#include "physics/preset.hpp"
#include "physics/profile.hpp"

namespace lutka::physics {

enum class MassTable { deLevaMale, deLevaFemale, winter };
/// How the total mass is split: by the table, by the table with ratios across constraints drawn together, or equally.
enum class MassPreset { anatomical, balanced, uniform, volume };

struct FitOptions {
    float totalMassKg = 75.0F;  ///< > 0.
    MassTable massTable = MassTable::deLevaMale;
    MassPreset massPreset = MassPreset::anatomical;
    RagdollPreset preset = RagdollPreset::anatomical;  ///< See applyPreset().
    bool shoulderBodies = false;                       ///< Bodies for the clavicles.
    bool neckBody = false;
    bool toeBodies = false;
    bool allTrunkBodies = false;  ///< A body for every mapped trunk role instead of hips, spine and the topmost.
};

/// A whole ragdoll from a mapped character: bodies from the skin each joint owns (from joint distances where there is
/// no skin), masses, anatomical limits, collision filter. The bind pose lies inside all limits.
/// Fails with ErrorCode::input when the map is not a humanoid's.
[[nodiscard]] Result<RagdollProfile> fitRagdoll(const animation::Character& character,
                                                const animation::HumanoidMap& map, const FitOptions& options = {});

}  // namespace lutka::physics
