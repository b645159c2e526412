#pragma once

namespace lutka::exporting {

inline constexpr const char* kPhysicsExtension = "KHR_physics_rigid_bodies";
inline constexpr const char* kShapesExtension = "KHR_implicit_shapes";
/// In the extras of a motion that we write: the body's name, and its role where it has one.
inline constexpr const char* kNameKey = "lutkaName";
inline constexpr const char* kRoleKey = "lutkaRole";
/// In the extras of a hull's geometry: its corners, as of the node's own axes.
inline constexpr const char* kCornersKey = "lutkaCorners";

}  // namespace lutka::exporting
