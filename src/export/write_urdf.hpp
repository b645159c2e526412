#pragma once

#include "export/export_ragdoll.hpp"

namespace lutka::exporting {

/// The ragdoll as a robot of ROS: docs/export.md, "URDF".
[[nodiscard]] Exported writeUrdf(const ExportSource& source);

}  // namespace lutka::exporting
