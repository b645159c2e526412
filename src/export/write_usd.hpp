#pragma once

#include "export/export_ragdoll.hpp"

namespace lutka::exporting {

/// The ragdoll as a USD stage with UsdPhysics: docs/export.md, "USD".
[[nodiscard]] Exported writeUsd(const ExportSource& source);

}  // namespace lutka::exporting
