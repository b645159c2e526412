#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "editor/view/selection.hpp"
#include "physics/powered/body_pin.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::editor {

/// Bodies that stay where they are while the others move: simulate selected only. They are known by their character and
/// name, so that they outlive a simulation that is made anew.
class HeldBodies {
  public:
    /// All bodies of these dolls, but for `moving`, are held where they are.
    void holdAllBut(std::span<const Item> moving, std::span<const int> dolls, scene::Simulation& simulation);
    void letGo();
    /// In the present simulation: a character that is gone, and may come back, holds nothing.
    [[nodiscard]] bool any() const { return !pins_.empty(); }
    [[nodiscard]] int count() const { return static_cast<int>(pins_.size()); }
    [[nodiscard]] bool holds(const scene::Simulation& simulation, int doll, int body) const;

    /// Before the simulation ends.
    void detach() { pins_.clear(); }
    /// After another one has begun: holds them there, where they were held before or, in dolls that are placed `anew`,
    /// where they are.
    void attach(scene::Simulation& simulation, const std::function<bool(int doll)>& anew);
    /// Before each step.
    void prepare(float dt);

  private:
    using Key = std::pair<scene::EntityId, std::string>;
    struct Pin {
        std::unique_ptr<physics::BodyPin> pin;
        RigidTransform worldFromBody;
    };

    std::map<Key, RigidTransform> places_;  // of their joints, world: a shape may move in its joint
    std::vector<Pin> pins_;                 // in the present simulation
};

}  // namespace lutka::editor
