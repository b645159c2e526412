#include "physics/crowd/kernels.hpp"

#include "core/assert.hpp"

namespace lutka::physics::crowd {

const Kernels& kernelsOf(InstructionSet set) {
    LUTKA_ASSERT(hasInstructionSet(set));
#ifdef LUTKA_CROWD_AVX
    if (set == InstructionSet::avx512) return kAvx512Kernels;
    if (set == InstructionSet::avx2) return kAvx2Kernels;
#endif
    return kBaselineKernels;
}

}  // namespace lutka::physics::crowd
