#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "report/drop_trace.hpp"
#include "scene/asset/ragdoll_asset.hpp"

namespace lutka::reporting {

/// What assets/report/model.js draws, as one JSON document; arrays of numbers are base64 of little-endian values.
/// - `textures`: data URIs, 512 pixels a side at most
/// - `meshes`: `positions` (float32 × 3, model space, bind pose), `normals` (int8 × 4), `uvs` (float32 × 2 or ""),
///   `tracks` (uint16 × 4) with `weights` (uint8 × 4, sum 255), `indices` (uint32), `color` (linear RGBA), `texture`
///   (index or -1), `doubleSided`, `blend`, `cutoff` (0: opaque)
/// - `bodies`, `constraints`: of the profile, radians and metres
/// - `secondsAPose`, `drops`: `poses`, `bodies` and `tracks` (float32 × 7 each: position, quaternion x y z w; pose
///   after pose), `contact` and `settle` (seconds since release or null)
///
/// A track moves skin from the bind pose into the world: worldFromJoint · bindModelFromJoint⁻¹. Joints that move skin
/// alike in all drops share one, so that fingers that follow a hand cost nothing.
[[nodiscard]] nlohmann::ordered_json dollViewJson(const scene::RagdollAsset& asset, std::span<const DropTrace> drops);

}  // namespace lutka::reporting
