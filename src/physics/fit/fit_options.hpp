#pragma once

#include "physics/fit/preset.hpp"

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

}  // namespace lutka::physics
