#pragma once

#include "export/export_ragdoll.hpp"

namespace lutka::exporting {

/// The ragdoll as a Python script for Blender: docs/export.md, "Blender".
[[nodiscard]] Exported writeBlender(const ExportSource& source);

}  // namespace lutka::exporting
