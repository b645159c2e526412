#pragma once

#include <memory>

#include "physics/profile/profile.hpp"
#include "physics/world/world.hpp"
#include "scene/asset/ragdoll_asset.hpp"

namespace lutka::test {

/// What two seconds of free flight cost a doll.
struct Loss {
    double angularMomentum = 0;  ///< Share of it.
    double momentum = 0;         ///< m/s that the centre of mass has gained.
    double energy = 0;           ///< Share that is gone at the end; negative: gained.
    double growth = 0;           ///< Largest rise over the least energy before, as a share.
};

/// A world of a solver without gravity, damping and sleep.
[[nodiscard]] std::unique_ptr<physics::World> emptySpace(physics::SolverKind solver);

/// Bodies that pass through each other.
[[nodiscard]] physics::RagdollProfile withoutContacts(physics::RagdollProfile profile);
/// Joints that neither rub nor stop as well: nothing is left that takes energy.
[[nodiscard]] physics::RagdollProfile withoutLosses(physics::RagdollProfile profile);

/// The profile's doll in the asset's bind pose, turning about its centre with `rate` (rad/s), in an empty world.
[[nodiscard]] Loss tumble(const scene::RagdollAsset& asset, const physics::RagdollProfile& profile,
                          physics::World& world, const vec3& rate);

}  // namespace lutka::test
