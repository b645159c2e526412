#include "animation/wide/kernels.hpp"

#include "core/assert.hpp"

namespace lutka::animation::wide {

const Kernels& kernelsOf(InstructionSet set) {
    LUTKA_ASSERT(hasInstructionSet(set));
#if defined(LUTKA_WIDE_AVX2)
    if (set != InstructionSet::baseline) return kAvx2Kernels;
#endif
    return kBaselineKernels;
}

}  // namespace lutka::animation::wide
