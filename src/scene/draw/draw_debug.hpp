#pragma once

#include <span>
#include <vector>

#include "physics/profile/constraint_state.hpp"
#include "render/frame.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/draw/debug_layers.hpp"

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

/// Buffers that drawing reuses from doll to doll and from frame to frame.
struct DebugScratch {
    std::vector<vec3> positions;
    std::vector<int> parents;
    std::vector<bool> inside;  ///< At or below a joint that owns a body.
};

/// Margins between which a limit is near (yellow); what is farther past it than the second counts as passed (red): a
/// solver holds limits softly, and angles are told in whole degrees.
inline constexpr float kNearLimit = radians(5.0F);
inline constexpr float kPassedLimit = radians(-1.0F);

/// How far inside its limits a constraint's present angle is, radians; negative: past them. Along the swing's own
/// direction in the elliptic cone.
[[nodiscard]] float limitMargin(const physics::ConstraintProfile& constraint, const physics::ConstraintState& state);
/// The same of the swing alone.
[[nodiscard]] float swingMargin(const physics::ConeTwistLimits& cone, const physics::ConstraintState& state);

/// Adds the layers of a doll; colours as in debugLayerInfos().
void drawDollDebug(const DollView& doll, const DebugLayers& layers, DebugScratch& scratch,
                   render::FrameDescription& frame);

}  // namespace lutka::scene
