#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "physics/crowd/crowd_world.hpp"
#include "physics/world/quality.hpp"
#include "physics/world/world.hpp"

namespace lutka::test {

inline constexpr float kStep = 1.0F / 60.0F;

/// The hand-made doll standing in its bind pose with its feet `height` metres above the origin, turned by `turn` about
/// its middle and moved by `offset`.
[[nodiscard]] std::vector<physics::BodyState> placedDoll(const physics::RagdollProfile& profile, const vec3& offset,
                                                         const quat& turn = quat(1, 0, 0, 0),
                                                         const vec3& velocity = vec3(0));

/// One body of one profile at the origin: a capsule along y.
[[nodiscard]] physics::RagdollProfile makeRod(float halfLength, float radius, float massKg);

/// A trunk along x and limbs side by side at its end: the first of 0.4 kg, the others of 10, `apart` metres beside it
/// to each of the `sides`.
struct Limbs {
    physics::RagdollProfile doll;
    std::vector<physics::BodyState> bodies;
};
[[nodiscard]] Limbs besideEachOther(const std::vector<float>& sides, float apart);

/// Of a doll of capsules, metres.
[[nodiscard]] float lowestPoint(const physics::RagdollProfile& profile, const std::vector<physics::BodyState>& bodies);

[[nodiscard]] physics::StaticShape floorPlane();
[[nodiscard]] physics::StaticShape staticBox(const vec3& centre, const vec3& halfExtents);

/// A floor with four walls, 6 × 6 m inside, and `count` dolls above it in layers of 4 × 4, turned at random; the layers
/// `apart` metres from each other.
void fillPit(physics::World& world, const physics::RagdollProfile& profile, int count,
             std::vector<physics::StaticShape>& statics, float apart = 2.1F);

/// Mass, centre of mass, momentum and angular momentum about the origin of one doll.
struct Totals {
    float massKg = 0.0F;
    vec3 centre{0, 0, 0};
    vec3 momentum{0, 0, 0};
    vec3 angularMomentum{0, 0, 0};
};
[[nodiscard]] Totals totalsOf(const physics::World& world, int doll);

[[nodiscard]] std::vector<physics::BodyState> bodiesOf(const physics::World& world, int doll);

/// Over all bodies of all dolls, bit for bit.
[[nodiscard]] std::uint64_t stateHash(const physics::World& world);

/// Steps with the figures taken after every substep.
[[nodiscard]] physics::Quality stepAndMeasure(physics::World& world, const std::vector<physics::StaticShape>& statics,
                                              float seconds);

}  // namespace lutka::test
