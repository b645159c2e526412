#pragma once

#include <string>
#include <vector>

#include "scene/asset/ragdoll_asset.hpp"

namespace lutka::scene {

/// A body of a figure in its standard stance.
struct FigureBody {
    physics::BodyShape shape;
    RigidTransform standardFromBody;
};

/// The standing figure's extent in its standard stance (Y up, facing +Z), relative to the rotated model's origin.
struct FigureBounds {
    vec3 low{0, 0, 0};
    vec3 high{0, 0, 0};
    float stance = 0.0F;  ///< Metres from the middle, level, that what it stands on reaches: the wider, the deeper a
                          ///< tilted figure dips.
    std::vector<FigureBody> bodies{};  ///< What it is made of; none: not known.
    std::string handBody{};            ///< Its left hand, or the last body of that arm; empty: it has none.
    vec3 hand{0, 0, 0};                ///< Where that is held (bodyFromHold()), in the standard stance.
    float handReach = 0.0F;            ///< Metres from there that it reaches at most, however its joints are stretched.
};
/// Where a limb's body is held, in its own frame: its far end, or its middle where it has none.
[[nodiscard]] vec3 bodyFromHold(const physics::RagdollProfile& profile, const physics::Rig& rig, int body);
/// Over the surfaces of all bodies in the bind pose.
[[nodiscard]] FigureBounds figureBounds(const physics::RagdollProfile& profile, const physics::Rig& rig);

/// What a scene has to know of a character to place it.
struct Figure {
    FigureBounds bounds;
    quat standardFromModel{1, 0, 0, 0};
};
[[nodiscard]] Figure figureOf(const RagdollAsset& asset);

}  // namespace lutka::scene
