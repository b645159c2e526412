#pragma once

#include <vector>

#include "animation/segments/appendages.hpp"
#include "physics/fit/preset.hpp"

namespace lutka::physics {

enum class MassTable { deLevaMale, deLevaFemale, winter };
/// How the total mass is split: by the table, by the table with ratios across constraints drawn together, or equally.
enum class MassPreset { anatomical, balanced, uniform, volume };

/// What a character is taken for.
enum class RigKind {
    humanoid,  ///< Bodies by roles; anything else is refused.
    any,       ///< Bodies by the topology of the rig alone, whatever it is (animation::segmentRig()).
};

struct FitOptions {
    RigKind rig = RigKind::humanoid;
    int mostBodies = 40;         ///< In [1, 256]; of any rig, see animation::SegmentOptions.
    float totalMassKg = 75.0F;   ///< > 0.
    bool weighByVolume = false;  ///< Of any rig: the total is that of its bodies' volume in water, not totalMassKg.
    MassTable massTable = MassTable::deLevaMale;
    MassPreset massPreset = MassPreset::anatomical;
    RagdollPreset preset = RagdollPreset::anatomical;  ///< See applyPreset().
    bool shoulderBodies = false;                       ///< Bodies for the clavicles.
    bool neckBody = false;
    bool toeBodies = false;
    /// Bodies for what hangs on a humanoid beside its parts, at most mostBodies of them.
    std::vector<animation::AppendageKind> appendages;
    int mostShapes = 1;           ///< A body, in [1, 3]: see fitShapes().
    bool hulls = false;           ///< Every body with skin is the convex hull of it: see fitHull().
    bool allTrunkBodies = false;  ///< A body for every mapped trunk role instead of hips, spine and the topmost.
};

}  // namespace lutka::physics
