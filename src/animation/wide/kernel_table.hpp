#pragma once

/// What a translation unit that defines LUTKA_KERNELS and LUTKA_LANE_COUNT includes to get that set's kernels.

#include "animation/wide/pose_kernels.hpp"
#include "animation/wide/sample_kernels.hpp"
#include "animation/wide/skin_kernels.hpp"

namespace lutka::animation::wide::LUTKA_KERNELS {

static constexpr Kernels kTable{kLanes, &skin, &skinByScalars, &follow, &propagate, &sample};

}  // namespace lutka::animation::wide::LUTKA_KERNELS
