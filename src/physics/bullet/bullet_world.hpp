#pragma once

#include <memory>

#include "physics/world/world.hpp"

namespace lutka::physics {

/// What SolverKind::bullet is set to; docs/physics.md says how the defaults were found. `stock` ignores it.
struct BulletTuning {
    int substeps = 8;     ///< Of one frame, >= 1. More: tighter joints and contacts, proportional cost.
    int sweeps = 80;      ///< At most, over all rows of an island in a substep, >= 1. More: tighter in hard impacts.
    int leastSweeps = 2;  ///< At least, >= 1.
    float tolerance = 0.02F;       ///< m/s: sweeping ends when no row was wrong by more. More: faster, looser.
    float restTolerance = 0.001F;  ///< m/s: the same for bodies that touch or are linked while their root mean square
                                   ///< speed is below restSpeed. More: some dolls rock on limits and edges for long.
    int mendSweeps = 24;           ///< At most, of the pass that mends positions, >= 1.

    float jointErp = 0.5F;        ///< Part of a joint's gap mended in a substep, (0, 1]. More: tighter.
    float limitErp = 0.3F;        ///< The same for angles past their limit.
    float contactErp = 0.3F;      ///< The same for penetration.
    float contactSlop = 0.0005F;  ///< Metres of penetration that are left alone, so that resting contacts stay.
    float contactMargin = 0.04F;  ///< Metres: how far apart shapes have contact points already (they only bound speed).
    float maxPushSpeed = 1.0F;    ///< m/s: bound on the speed at which overlapping shapes part.
    float rollingArm = 0.01F;  ///< Metres: resistance to rolling, as the arm of the normal force. More: rolls less far.
    float leastGyration =
        0.05F;              ///< Metres, of a figure 1.75 m tall: no body has a smaller radius of gyration about any
                            ///< axis; thin hands and feet are given more inertia. More: tighter, more sluggish.
    bool warmStart = true;  ///< Starts each substep from the impulses of the one before.

    float linearDamping = 0.02F;  ///< Part of the speed lost in a second, [0, 1]: air.
    float angularDamping = 0.4F;  ///< The same for turning.
    float restDamping = 4.0F;     ///< 1/s: further damping of what touches something and is slower than
    float restSpeed = 0.1F;       ///< m/s and
    float restTurn = 0.8F;        ///< rad/s. More: sooner asleep, stiffer last movements.
    float quietSpeed = 0.05F;     ///< m/s: where the root mean square over the mass of all bodies that touch or are
                               ///< linked is below, each of them is damped so, whatever its own speed. More: feet and
                               ///< hands that hang from a resting doll stop sooner; much more slows the last falls.
    float sleepSpeed = 0.03F;  ///< m/s, and
    float sleepTurn = 0.04F;   ///< rad/s: slower for `sleepSeconds`, all bodies that touch fall asleep.
    float sleepSeconds = 1.0F;
};

/// A Bullet world behind the World interface. SolverKind::stock is a plain btDiscreteDynamicsWorld with Bullet's own
/// defaults, the baseline of every ratio; SolverKind::bullet has our settings (docs/physics.md).
[[nodiscard]] std::unique_ptr<World> createBulletWorld(const WorldSettings& settings, const BulletTuning& tuning = {});

}  // namespace lutka::physics
