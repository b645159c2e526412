#pragma once

#include <string>

#include "animation/import/assimp/collada_tags.hpp"

namespace lutka::animation::rig_import {

struct StraightenedCollada {
    std::string text;
    bool isWhole = true;  ///< Else curves were left as they are, for all together would be too many numbers.
};

/// Writes the curves of a tidied Collada document (tidyCollada()) that hold their keys (STEP) or are Bezier splines as
/// straight pieces, 60 a second: Assimp 5.2.5 plays all curves as straight lines from key to key.
[[nodiscard]] StraightenedCollada straightenedCollada(std::string text);

/// Whether a document has curves of kinds that stay straight from key to key: CARDINAL and BSPLINE.
[[nodiscard]] bool holdsOtherCurves(const ColladaDocument& document);

}  // namespace lutka::animation::rig_import
