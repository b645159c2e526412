#pragma once

#include <span>
#include <vector>

#include "render/frame.hpp"
#include "scene/draw/debug_layers.hpp"
#include "scene/draw/draw_debug.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::scene {

/// Fills a frame with what a simulation shows. Keeps its buffers from frame to frame. The palettes are the simulation's
/// (Simulation::poseSkins): they stay valid until it is drawn anew or ends.
class SimulationDrawer {
  public:
    /// Appends characters, props, static geometry, lights and debug layers to `frame` (which is not cleared), and sets
    /// its floor, hiddenLineOpacity and, when the scene has one, its sun. `characters`: the uploaded character of each
    /// of the simulation's assets. `alpha` as in Simulation::pose; `opacity` of the skins, 0 leaves them out.
    void draw(Simulation& simulation, std::span<const render::CharacterHandle> characters, const DebugLayers& layers,
              float alpha, float opacity, render::FrameDescription& frame);
    void draw(Simulation& simulation, render::CharacterHandle character, const DebugLayers& layers, float alpha,
              float opacity, render::FrameDescription& frame) {
        draw(simulation, std::span(&character, 1), layers, alpha, opacity, frame);
    }

    /// Wall time of the poses and palettes of the last draw(), milliseconds.
    [[nodiscard]] double poseMs() const { return poseMs_; }
    /// How many dolls were posed for the last draw(); the others rested where they were drawn before.
    [[nodiscard]] int posedDolls() const { return posedDolls_; }

    /// Which of the frame's characters a doll was drawn as; -1: not at all.
    [[nodiscard]] int characterItem(int doll) const { return itemOfDoll_[static_cast<std::size_t>(doll)]; }

    /// Of every doll's skin.
    animation::SkinningMethod skinning = animation::SkinningMethod::linear;

  private:
    void drawContacts(Simulation& simulation, render::FrameDescription& frame);

    std::vector<int> itemOfDoll_;
    std::vector<physics::BodyState> states_;
    std::vector<physics::ContactPoint> contacts_;
    DebugScratch scratch_;
    double poseMs_ = 0.0;
    int posedDolls_ = 0;
};

/// The scene's own camera; without one a view of the scenario's focus.
[[nodiscard]] render::Camera cameraFor(const Scenario& scenario, float aspect);

}  // namespace lutka::scene
