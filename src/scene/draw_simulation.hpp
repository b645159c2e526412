#pragma once

#include <vector>

#include "render/frame.hpp"
#include "scene/debug_layers.hpp"
#include "scene/draw_debug.hpp"
#include "scene/simulation.hpp"

namespace lutka::scene {

/// Fills a frame with what a simulation shows. Keeps its buffers from frame to frame; palettes stay valid until the
/// next call of draw().
class SimulationDrawer {
  public:
    /// Appends characters, props, static geometry and debug layers to `frame` (which is not cleared), and sets its
    /// floor and hiddenLineOpacity. `alpha` as in Simulation::pose; `opacity` of the skins, 0 leaves them out.
    void draw(Simulation& simulation, render::CharacterHandle character, const DebugLayers& layers, float alpha,
              float opacity, render::FrameDescription& frame);

    /// World positions of a doll's joints as last drawn, jointCount() long.
    [[nodiscard]] std::span<const RigidTransform> modelFromJoint(int doll) const;

    /// Of every doll's skin.
    animation::SkinningMethod skinning = animation::SkinningMethod::linear;

  private:
    void drawSkin(Simulation& simulation, int doll, float alpha);
    void drawContacts(Simulation& simulation, render::FrameDescription& frame);
    template <class T>
    [[nodiscard]] std::span<T> ofDoll(std::span<T> all, int doll) const {
        return all.subspan(joints_ * static_cast<std::size_t>(doll), joints_);
    }

    std::vector<RigidTransform> poses_;
    std::vector<animation::SkinMatrix> palettes_;
    std::vector<physics::BodyState> states_;
    std::vector<physics::ContactPoint> contacts_;
    DebugScratch scratch_;
    std::size_t joints_ = 0;
};

/// A camera that shows the scenario's focus.
[[nodiscard]] render::Camera cameraFor(const Scenario& scenario, float aspect);

}  // namespace lutka::scene
