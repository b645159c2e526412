#pragma once

#include <string>

namespace lutka::animation::rig_import {

/// The document with the targets of its animations as Assimp 5.2.5 knows them: a rotation's fourth number, `(3)`, is
/// its `.ANGLE`, and the names of members are capitals. It drops other channels in silence.
[[nodiscard]] std::string withPlainTargets(const std::string& document);

}  // namespace lutka::animation::rig_import
