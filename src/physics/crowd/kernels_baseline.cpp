#define LUTKA_KERNELS baseline8
#define LUTKA_LANE_COUNT 8
#include "physics/crowd/kernel_table.hpp"

namespace lutka::physics::crowd {

extern const Kernels kBaselineKernels;
const Kernels kBaselineKernels = baseline8::kTable;

}  // namespace lutka::physics::crowd
