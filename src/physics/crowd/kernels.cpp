#include "physics/crowd/kernels.hpp"

#include "core/assert.hpp"

namespace lutka::physics::crowd {

bool hasInstructionSet(InstructionSet set) {
    if (set == InstructionSet::baseline) return true;
#ifdef LUTKA_CROWD_AVX2
    return __builtin_cpu_supports("avx2") != 0;
#else
    return false;
#endif
}

InstructionSet bestInstructionSet() {
    return hasInstructionSet(InstructionSet::avx2) ? InstructionSet::avx2 : InstructionSet::baseline;
}

const Kernels& kernelsOf(InstructionSet set) {
    LUTKA_ASSERT(hasInstructionSet(set));
#ifdef LUTKA_CROWD_AVX2
    if (set == InstructionSet::avx2) return kAvx2Kernels;
#endif
    return kBaselineKernels;
}

}  // namespace lutka::physics::crowd
