#define LUTKA_CROWD_KERNELS baseline
#include "physics/crowd/kernel_table.hpp"

namespace lutka::physics::crowd {

extern const Kernels kBaselineKernels;
const Kernels kBaselineKernels = baseline::kTable;

}  // namespace lutka::physics::crowd
