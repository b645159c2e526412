#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "physics/world/quality.hpp"
#include "physics/world/world.hpp"
#include "scene/asset/ragdoll_asset.hpp"

namespace lutka::test {

/// One character's fall in a named scene.
struct FallSettings {
    std::string scene = "drop";
    std::uint64_t seed = 0;
    float seconds = 8.0F;
    std::vector<float> frames = {1.0F / 60.0F};  ///< Seconds of the steps, over and over.
    /// Called once it is over, before the world goes; may be empty.
    std::function<void(const physics::World&, physics::DollId)> atEnd = {};
};

/// What came of it.
struct Fall {
    physics::Quality quality;
    std::string worstJoint;        ///< The role of the child whose limit was overrun most for two frames.
    float hipsHeightShare = 0.0F;  ///< Height of the hips' joint at the end over that of the standing figure.
    float trunkLeanDeg = 0.0F;     ///< Between the vertical and the line from hips to neck (or head) at the end.

    /// Whether the figure lies as what nothing holds up does.
    [[nodiscard]] bool lies() const { return hipsHeightShare < 0.35F && trunkLeanDeg > 45.0F; }
};

/// Lets one character fall in an empty world. Fails as makeScenario does.
[[nodiscard]] Result<Fall> fall(const scene::RagdollAsset& asset, std::unique_ptr<physics::World> world,
                                const FallSettings& settings);

/// Loads a model's figure without its textures.
[[nodiscard]] Result<std::unique_ptr<scene::RagdollAsset>> loadFigure(const std::string& file);

}  // namespace lutka::test
