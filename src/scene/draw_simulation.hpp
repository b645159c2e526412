#pragma once

#include <string_view>
#include <vector>

#include "render/frame.hpp"
#include "scene/simulation.hpp"

namespace lutka::scene {

/// Which debug layers are drawn over the picture.
struct DebugLayers {
    bool capsules = false;       ///< Wireframe of every body over all; coloured by sleep.
    bool solidCapsules = false;  ///< The same as translucent solids.
    bool joints = false;         ///< The skeleton and the axes of mapped joints.
    bool limits = false;         ///< Arcs (hinge) and cones with twist sector, coloured near and past the limit.
    bool contacts = false;       ///< Contact points and normals of the last substep.
    bool velocities = false;     ///< Linear velocity of each body's centre, 0.1 s long.
    bool centresOfMass = false;  ///< Centre and inertia box of each body.
    bool aabbs = false;          ///< World boxes around the bodies.
};

/// Parses "capsules,joints,limits,contacts,velocities,com,aabbs,solids". Fails with ErrorCode::usage on another word.
[[nodiscard]] Result<DebugLayers> parseDebugLayers(std::string_view list);

/// Fills a frame with what a simulation shows. Keeps its buffers from frame to frame; palettes stay valid until the
/// next call of draw().
class SimulationDrawer {
  public:
    /// Appends characters, props, static geometry and debug layers to `frame` (which is not cleared), and sets its
    /// floor. `alpha` as in Simulation::pose; `opacity` of the skins, 0 leaves them out.
    void draw(Simulation& simulation, render::CharacterHandle character, const DebugLayers& layers, float alpha,
              float opacity, render::FrameDescription& frame);

    /// World positions of a doll's joints as last drawn, jointCount() long.
    [[nodiscard]] std::span<const RigidTransform> modelFromJoint(int doll) const;

    /// Of every doll's skin.
    animation::SkinningMethod skinning = animation::SkinningMethod::linear;

  private:
    std::vector<RigidTransform> poses_;
    std::vector<animation::SkinMatrix> palettes_;
    std::vector<physics::BodyState> states_;
    std::vector<physics::ContactPoint> contacts_;
    std::size_t joints_ = 0;
};

/// A camera that shows the scenario's focus.
[[nodiscard]] render::Camera cameraFor(const Scenario& scenario, float aspect);

}  // namespace lutka::scene
