#include "physics/crowd/kernels.hpp"

#include "core/assert.hpp"

namespace lutka::physics::crowd {

bool hasInstructionSet(InstructionSet set) {
    if (set == InstructionSet::baseline) return true;
#ifdef LUTKA_CROWD_AVX
    if (set == InstructionSet::avx2) return __builtin_cpu_supports("avx2") != 0;
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vl") != 0 &&
           __builtin_cpu_supports("avx512dq") != 0;
#else
    return false;
#endif
}

InstructionSet bestInstructionSet() {
    if (hasInstructionSet(InstructionSet::avx512)) return InstructionSet::avx512;
    return hasInstructionSet(InstructionSet::avx2) ? InstructionSet::avx2 : InstructionSet::baseline;
}

const Kernels& kernelsOf(InstructionSet set) {
    LUTKA_ASSERT(hasInstructionSet(set));
#ifdef LUTKA_CROWD_AVX
    if (set == InstructionSet::avx512) return kAvx512Kernels;
    if (set == InstructionSet::avx2) return kAvx2Kernels;
#endif
    return kBaselineKernels;
}

}  // namespace lutka::physics::crowd
