#define LUTKA_KERNELS baseline4
#define LUTKA_LANE_COUNT 4
#include "animation/wide/kernel_table.hpp"

namespace lutka::animation::wide {

extern const Kernels kBaselineKernels;
const Kernels kBaselineKernels = baseline4::kTable;

}  // namespace lutka::animation::wide
