#pragma once

#include "animation/wide/layout.hpp"
#include "core/instruction_set.hpp"

namespace lutka::animation::wide {

/// Kernels of a set that is there (avx512 has none of its own: avx2's).
[[nodiscard]] const Kernels& kernelsOf(InstructionSet set);

// Each defined by its own translation unit.
extern const Kernels kBaselineKernels;
extern const Kernels kAvx2Kernels;

}  // namespace lutka::animation::wide
