#pragma once

#include "export/export_ragdoll.hpp"

namespace lutka::exporting {

/// The ragdoll as C++ that builds it with plain Bullet: docs/export.md, "Bullet".
[[nodiscard]] Exported writeBullet(const ExportSource& source);

}  // namespace lutka::exporting
