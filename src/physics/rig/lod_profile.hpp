#pragma once

#include <span>
#include <vector>

#include "physics/rig/rig.hpp"

namespace lutka::physics {

/// How much of a ragdoll is merged.
enum class LodLevel {
    limbs,  ///< Hands, feet and toes into the limb above them, the trunk between hips and neck into one body: 16 → 11.
    block,  ///< Also the whole trunk with neck and head into the hips, and each arm into one body: 16 → 7.
};  // Bodies without a role: `limbs` merges the end of each chain with the link above it, `block` unbranched chains.

/// A cheaper ragdoll of the same character: bodies of the full one are merged, each group under its uppermost body.
///
/// Mass, centre of mass and inertia of a group are those of its bodies in the bind pose (parallel axes), its frame the
/// principal one with y along the longest extent. A group hangs on the joint of its uppermost body with that joint's
/// frames, limits and friction. Shapes are capsules (a box or sphere that stays alone keeps its shape), symmetric about
/// the centre of mass: the same volume roughly, not the same outline.
struct LodProfile {
    RagdollProfile profile;
    std::vector<int> bodyOf;                  ///< One a body of the full profile: the merged body that holds it.
    std::vector<RigidTransform> lodFromBody;  ///< One a body of the full profile: its place there in the bind pose.
    std::vector<int> upper;                   ///< One a merged body: its uppermost member in the full profile.
};

/// `rig` binds `full`. A profile without anything to merge comes back as it is.
[[nodiscard]] LodProfile makeLodProfile(const RagdollProfile& full, const Rig& rig, LodLevel level);

/// A full doll's state in merged bodies. Orientations are those of each group's uppermost body, positions close the
/// constraints from the root on; momentum and angular momentum of each group are kept. `lodFromMember` takes, for each
/// body of the full profile, its rotation against its merged body at this moment: what lodToFull() needs to show the
/// pose unchanged. Sizes: one a body of the full profile, but for `lodBodies`, one a merged body.
void fullToLod(const LodProfile& lod, const RagdollProfile& full, std::span<const BodyState> bodies,
               std::span<BodyState> lodBodies, std::span<quat> lodFromMember);

/// The full doll that the merged bodies carry: members move rigidly with their group as they were when it was made, and
/// positions close the full profile's constraints from the root on. Right after fullToLod() all rotations are those of
/// before to rounding, and so is the drawn pose, which rests on rotations and the root (see poseFromBodies()).
void lodToFull(const LodProfile& lod, const RagdollProfile& full, std::span<const BodyState> lodBodies,
               std::span<const quat> lodFromMember, std::span<BodyState> bodies);

}  // namespace lutka::physics
