#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "physics/world/quality.hpp"
#include "physics/world/world.hpp"

/// What the tests of all three worlds share.
namespace lutka::test {

inline constexpr float kFrame = 1.0F / 60.0F;

inline constexpr std::array<physics::SolverKind, 3> kAllSolvers{physics::SolverKind::stock, physics::SolverKind::bullet,
                                                                physics::SolverKind::crowd};
/// Those that keep quality bounds.
inline constexpr std::array<physics::SolverKind, 2> kOurSolvers{physics::SolverKind::bullet,
                                                                physics::SolverKind::crowd};

[[nodiscard]] std::unique_ptr<physics::World> worldOf(physics::SolverKind solver,
                                                      physics::WorldSettings settings = physics::WorldSettings{});

/// One body of a profile, as a doll: a capsule along y, or a box where `halfExtents` is given.
[[nodiscard]] physics::RagdollProfile rodProfile(float halfLength, float radius, float massKg = 2.0F);
[[nodiscard]] physics::RagdollProfile crateProfile(const vec3& halfExtents, float massKg = 2.0F);

[[nodiscard]] physics::BodyState stateAt(const vec3& position, const quat& rotation = quat(1, 0, 0, 0),
                                         const vec3& velocity = vec3(0));
[[nodiscard]] physics::BodyState bodyOfDoll(const physics::World& world, int doll, int body = 0);
[[nodiscard]] std::vector<physics::BodyState> bodiesOfDoll(const physics::World& world, int doll);
/// The hand-made doll, standing with its feet at `position`.
[[nodiscard]] std::vector<physics::BodyState> standingDoll(const physics::RagdollProfile& profile, const vec3& position,
                                                           const quat& turn = quat(1, 0, 0, 0),
                                                           const vec3& velocity = vec3(0));

void stepSeconds(physics::World& world, float seconds);
/// With the figures after every substep.
[[nodiscard]] physics::Quality measureSeconds(physics::World& world, std::span<const physics::StaticShape> statics,
                                              float seconds);

/// Meshes: a square grid in the plane y = 0 with `cells` cells a side, `size` metres wide, heights by a function of x,
/// z; a closed box.
[[nodiscard]] std::shared_ptr<const physics::TriangleMesh> gridMesh(int cells, float size,
                                                                    float (*height)(float, float) = nullptr);
[[nodiscard]] std::shared_ptr<const physics::TriangleMesh> boxMesh(const vec3& halfExtents);
[[nodiscard]] physics::StaticShape staticMesh(std::shared_ptr<const physics::TriangleMesh> mesh,
                                              const vec3& position = vec3(0));
[[nodiscard]] physics::StaticShape staticBoxAt(const vec3& centre, const vec3& halfExtents);

}  // namespace lutka::test
