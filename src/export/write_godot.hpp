#pragma once

#include "export/export_ragdoll.hpp"

namespace lutka::exporting {

enum class GodotVersion { three, four };

/// The ragdoll as a text scene of Godot: docs/export.md, "Godot".
[[nodiscard]] Exported writeGodot(const ExportSource& source, GodotVersion version);

}  // namespace lutka::exporting
