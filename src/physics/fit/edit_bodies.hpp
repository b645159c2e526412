#pragma once

#include "animation/character.hpp"
#include "animation/humanoid/map_humanoid.hpp"
#include "core/result.hpp"
#include "physics/profile/profile.hpp"

/// Bodies added, removed, merged and split by hand, on any joint of a rig. Each gives a valid profile of the same total
/// mass; bodies that the change does not concern keep everything, and what hangs on others keeps its place.
namespace lutka::physics {

/// A body for the joint and what follows it, with the shape that its skin asks for, hung on the nearest body above.
/// Bodies below the joint that hung there hang on it from then on. It takes mass from the body above by volume.
/// Fails with ErrorCode::usage when the joint has a body, lies above the root's, or there are kMostBodies.
[[nodiscard]] Result<RagdollProfile> addBody(const RagdollProfile& profile, const animation::Character& character,
                                             const animation::HumanoidMap& map, int joint);

/// Takes the body away. What hung on it hangs on the body above, which takes its mass; shapes stay.
/// Fails with ErrorCode::usage for the root.
[[nodiscard]] Result<RagdollProfile> removeBody(const RagdollProfile& profile, const animation::Character& character,
                                                int body);

/// removeBody(), and the body above is fitted to the skin of both.
[[nodiscard]] Result<RagdollProfile> mergeBody(const RagdollProfile& profile, const animation::Character& character,
                                               const animation::HumanoidMap& map, int body);

/// Parts the body at the joint nearest to its middle: that joint gets a body of its own, and both are fitted anew.
/// Fails with ErrorCode::usage when no joint lies inside the body.
[[nodiscard]] Result<RagdollProfile> splitBody(const RagdollProfile& profile, const animation::Character& character,
                                               const animation::HumanoidMap& map, int body);

/// The convex hull of a body's skin (fitHull()) as its shape, and its place in the body's joint.
struct HullOfSkin {
    BodyShape shape;
    RigidTransform jointFromBody;
};
/// Fails with ErrorCode::usage where the body has next to no skin, or flat skin.
[[nodiscard]] Result<HullOfSkin> hullOfSkin(const RagdollProfile& profile, const animation::Character& character,
                                            const animation::HumanoidMap& map, int body);

/// The root alone, fitted to the skin of all: what a ragdoll made by hand begins with.
[[nodiscard]] RagdollProfile rootAlone(const RagdollProfile& profile, const animation::Character& character,
                                       const animation::HumanoidMap& map);

/// The body that carries a joint: its own, else the nearest above; -1 above the root's joint.
[[nodiscard]] int bodyCarryingJoint(const RagdollProfile& profile, const animation::Skeleton& skeleton, int joint);

}  // namespace lutka::physics
