#pragma once

#include <span>
#include <vector>

#include "physics/fit/fit_options.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// The share of the whole body's mass that a role's own segment has, by the table, when every role has a body of its
/// own: the trunk's lower, middle and upper third go to hips, spine and chest; upperChest takes half of the chest's,
/// the neck a fifth of the head's, a clavicle a tenth of the upper trunk's, toes a fifth of the foot's (the last four
/// are ours, the tables stop above them). All roles together sum to 1 within 0.0005.
/// Sources: de Leva 1996 (J. Biomechanics 29) after Zatsiorsky-Seluyanov; Winter, Biomechanics and Motor Control of
/// Human Movement, after Dempster; figures as tabulated by BMClab.
[[nodiscard]] float segmentMassShare(MassTable table, Role role);

/// Writes masses (their sum is options.totalMassKg to 1e-6 of it) and the inertia of each shape into the bodies. The
/// segment of a role without a body is carried by another (carrierOf).
/// Bodies without a role have half the density of those with one; where none has, shares go by volume.
/// `balanced` takes the square root of the table's shares, which halves every ratio on the logarithmic scale.
void assignMasses(std::span<BodyProfile> bodies, const FitOptions& options);

/// Gives every body without a role at least 0.7 of the mass of each of its children and 0.2 of its parent's: solvers
/// hold no heavy body by a light one. All masses are then scaled to the total that they had; inertias follow.
void raiseLightSegments(RagdollProfile& profile);

/// The role itself when it has a body, else the nearest body above it in its limb, else the nearest below it there,
/// else the nearest above the limb; hips when there is none.
[[nodiscard]] Role carrierOf(Role role, std::span<const BodyProfile> bodies);

}  // namespace lutka::physics
