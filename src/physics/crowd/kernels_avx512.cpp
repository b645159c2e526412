// Compiled for AVX-512: include nothing here but the kernels, since an inline function of another header would be
// compiled for AVX-512 too and might be the copy that the linker keeps for the whole program.
#define LUTKA_KERNELS avx512
#define LUTKA_LANE_COUNT 8
#include "physics/crowd/kernel_table.hpp"

namespace lutka::physics::crowd {

extern const Kernels kAvx512Kernels;
const Kernels kAvx512Kernels = avx512::kTable;

}  // namespace lutka::physics::crowd
