// Compiled for AVX2: include nothing here but the kernels, since an inline function of another header would be
// compiled for AVX2 too and might be the copy that the linker keeps for the whole program.
#define LUTKA_KERNELS avx2
#define LUTKA_LANE_COUNT 8
#include "physics/crowd/kernel_table.hpp"

namespace lutka::physics::crowd {

extern const Kernels kAvx2Kernels;
const Kernels kAvx2Kernels = avx2::kTable;

}  // namespace lutka::physics::crowd
