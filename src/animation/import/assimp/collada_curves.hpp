#pragma once

#include <string>

namespace lutka::animation::rig_import {

struct StraightenedCollada {
    std::string text;
    bool isWhole = true;  ///< Else curves were left as they are, for all together would be too many numbers.
};

/// Writes the curves of a tidied Collada document (tidyCollada()) that hold their keys (STEP) or are Bezier splines as
/// straight pieces, 60 a second: Assimp 5.2.5 plays all curves as straight lines from key to key.
[[nodiscard]] StraightenedCollada straightenedCollada(std::string text);

}  // namespace lutka::animation::rig_import
