#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "physics/collision/static_shape.hpp"
#include "physics/world/world_view.hpp"

namespace lutka::physics {

/// The report's figures (docs/cli.md). All but settleSeconds over every doll of the world.
struct Quality {
    struct {
        float max = 0, p99 = 0, mean = 0;
    } jointSeparationM;
    struct {
        float max = 0, p99 = 0;
        float lasting = 0;  ///< Largest that one joint held for two frames of 1/60 s.
    } limitViolationDeg;
    float floorPenetrationM = 0;  ///< Largest, into any static shape, by analytic distance.
    float selfPenetrationM = 0;   ///< Largest between bodies of one doll that may collide.
    struct {
        float max = 0, p99 = 0;
    } dollPenetrationM;  ///< Between bodies of different dolls, once a frame; p99 over pairs less than 1 cm apart.
    /// Largest rise over the running minimum, less the work of drags, motors, forces and impulses.
    float energyGrowthJ = 0;
    float initialEnergyJ = 0;  ///< At release, for the growth's share.
    /// From the first contact until all dolls are asleep or below 1 cm/s; unset: never.
    std::optional<float> settleSeconds;
    float residualSpeedMps = 0;  ///< Root mean square of the bodies' speeds at the end.
    std::int64_t nonFinite = 0;  ///< Body states that were not finite.
};

/// Takes the figures after every substep of a world, independent of its solver.
class QualityMeter {
  public:
    /// `statics` and `world` must outlive the meter. `gravity` in m/s².
    QualityMeter(const WorldView& world, std::span<const StaticShape> statics, const vec3& gravity);
    ~QualityMeter();

    /// Call after every substep with the time since release.
    void sample(double secondsSinceRelease);
    [[nodiscard]] Quality result() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lutka::physics
