#pragma once

#include "export/export_ragdoll.hpp"

namespace lutka::exporting {

enum class GltfKind { binary, text };

/// The character with its ragdoll as KHR_physics_rigid_bodies and KHR_implicit_shapes (drafts): docs/export.md, "glTF".
/// Fails where the character can't be written.
[[nodiscard]] Result<Exported> writeGltf(const ExportSource& source, GltfKind kind);

}  // namespace lutka::exporting
