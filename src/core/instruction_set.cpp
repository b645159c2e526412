#include "core/instruction_set.hpp"

namespace lutka {

bool hasInstructionSet(InstructionSet set) {
    if (set == InstructionSet::baseline) return true;
#if defined(__x86_64__)
    const bool avx2 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
    if (set == InstructionSet::avx2) return avx2;
    return avx2 && __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vl") != 0 &&
           __builtin_cpu_supports("avx512dq") != 0;
#else
    return false;
#endif
}

InstructionSet bestInstructionSet() {
    if (hasInstructionSet(InstructionSet::avx512)) return InstructionSet::avx512;
    return hasInstructionSet(InstructionSet::avx2) ? InstructionSet::avx2 : InstructionSet::baseline;
}

}  // namespace lutka
