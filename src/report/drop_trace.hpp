#pragma once

#include <optional>
#include <vector>

#include "core/rigid_transform.hpp"
#include "physics/profile/body_state.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::reporting {

/// One drop over time.
struct DropTrace {
    static constexpr int kStepsAPose = 2;  ///< Poses are kept at 30 Hz: a viewer blends between them.

    float dt = 1.0F / 60.0F;  ///< Seconds between figures.
    // One at the start and one after each step, taken between substeps; Quality's own are taken after every substep.
    std::vector<float> energyJ;                 ///< Kinetic and potential, over the floor.
    std::vector<float> separationM;             ///< The widest of all joints.
    std::vector<float> violationDeg;            ///< The farthest past its limit of all joints.
    std::optional<float> firstContactS;         ///< Since release; unset: it never touched anything.
    int poses = 0;                              ///< How many are kept.
    std::vector<RigidTransform> worldFromBody;  ///< Pose after pose.
    std::vector<RigidTransform> worldFromJoint;
};

/// Takes the trace of a simulation's first doll.
class DropRecorder {
  public:
    /// Call at the start and after each step.
    void sample(scene::Simulation& simulation);
    [[nodiscard]] const DropTrace& trace() const { return trace_; }

  private:
    void sampleFigures(const scene::Simulation& simulation);
    void samplePose(scene::Simulation& simulation);

    DropTrace trace_;
    std::vector<physics::BodyState> bodies_;
    std::vector<RigidTransform> modelFromJoint_;
};

/// A figure that is not simulated: one pose, standing on the floor in the bind pose.
[[nodiscard]] DropTrace standingTrace(const scene::RagdollAsset& asset);

}  // namespace lutka::reporting
