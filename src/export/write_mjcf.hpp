#pragma once

#include "export/export_ragdoll.hpp"

namespace lutka::exporting {

/// The ragdoll as a model of MuJoCo on a floor: docs/export.md, "MJCF".
[[nodiscard]] Exported writeMjcf(const ExportSource& source);

}  // namespace lutka::exporting
