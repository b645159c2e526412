#pragma once

#include <span>

#include "render/frame.hpp"
#include "scene/draw_simulation.hpp"
#include "scene/ragdoll_asset.hpp"

namespace lutka::scene {

/// One doll as debug draw sees it; spans as in Simulation.
struct DollView {
    const RagdollAsset& asset;
    std::span<const RigidTransform> worldFromBody;   ///< One a body.
    std::span<const physics::BodyState> states;      ///< One a body; velocities.
    std::span<const RigidTransform> modelFromJoint;  ///< One a joint.
    RigidTransform worldFromModel;
    bool asleep = false;
};

/// Colours (the legend is in docs/editor.md): bodies green awake, grey-blue asleep; limits cyan, yellow within 5
/// degrees of the limit, red past it.
void drawDollDebug(const DollView& doll, const DebugLayers& layers, render::FrameDescription& frame);

}  // namespace lutka::scene
