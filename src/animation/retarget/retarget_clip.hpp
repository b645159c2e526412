#pragma once

#include "animation/retarget/retarget_figures.hpp"

namespace lutka::animation {

struct RetargetOptions {
    bool keepFeet = true;  ///< False: the legs only turn as the source's do.
    ContactSettings contacts;
};

/// A clip of the target's skeleton, and how true it is to the source.
struct RetargetedClip {
    Clip clip;  ///< The source clip's name, rate and number of frames.
    RetargetFigures figures;
};

/// Takes a whole clip over, feet on the floor: the source's floor is found from its motion. Fails with ErrorCode::input
/// when the clip is not one of the source's skeleton, or has frames that are not finite.
[[nodiscard]] Result<RetargetedClip> retargetClip(Retargeter& retargeter, const Clip& clip,
                                                  const RetargetOptions& options = {});

}  // namespace lutka::animation
