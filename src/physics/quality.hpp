#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "physics/world.hpp"

namespace lutka::physics {

/// The report's figures (DESIGN section 6). All but settleSeconds over every doll of the world.
struct Quality {
    struct {
        float max = 0, p99 = 0, mean = 0;
    } jointSeparationM;
    struct {
        float max = 0, p99 = 0;
    } limitViolationDeg;
    float floorPenetrationM = 0;  ///< Largest, into any static shape, by analytic distance.
    float selfPenetrationM = 0;   ///< Largest between bodies of one doll that may collide.
    float energyGrowthJ = 0;      ///< Largest rise over the running minimum, less the work of drags, motors and forces.
    float initialEnergyJ = 0;     ///< At release, for the growth's share.
    std::optional<float>
        settleSeconds;           ///< From the first contact until all dolls are asleep or below 1 cm/s; unset: never.
    float residualSpeedMps = 0;  ///< Root mean square of the bodies' speeds at the end.
    std::int64_t nonFinite = 0;  ///< Body states that were not finite.
};

/// Where a constraint stands: the two anchors' distance and how far past its limits it is (0 inside).
struct ConstraintState {
    float separationM = 0;
    float violation = 0;   ///< Radians past the nearest limit.
    float hingeAngle = 0;  ///< Radians, hinge only.
    vec3 swing{0, 0, 0};   ///< Rotation vector of the swing in the parent frame (x = 0), cone-twist only.
    float twist = 0;       ///< Radians, cone-twist only.
};
[[nodiscard]] ConstraintState measureConstraint(const ConstraintProfile& constraint,
                                                const RigidTransform& worldFromParent,
                                                const RigidTransform& worldFromChild);

/// Signed distance from the body's surface to the static shape's, metres; negative: the depth of the overlap.
[[nodiscard]] float distanceToStatic(const BodyShape& shape, const RigidTransform& worldFromBody,
                                     const StaticShape& geometry);

/// Takes the figures after every substep of a world, independent of its solver.
class QualityMeter {
  public:
    /// `statics` and `world` must outlive the meter. `gravity` in m/s².
    QualityMeter(const World& world, std::span<const StaticShape> statics, const vec3& gravity);
    ~QualityMeter();

    /// Call after every substep with the time since release.
    void sample(double secondsSinceRelease);
    [[nodiscard]] Quality result() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lutka::physics
