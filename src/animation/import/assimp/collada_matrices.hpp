#pragma once

#include <string>

#include "animation/import/assimp/collada_curves.hpp"

namespace lutka::animation::rig_import {

/// Joins the channels of a settled and straightened document that each move one number of a matrix, `id/sid(i)(j)` or
/// `id/sid(i)`, to channels of whole matrices: Assimp 5.2.5 takes `(i)(j)` for column and row, where others mean row
/// and column. The one is meant that leaves a matrix its last row of 0 0 0 1; where both do, row and column.
[[nodiscard]] StraightenedCollada withWholeMatrices(std::string text);

}  // namespace lutka::animation::rig_import
