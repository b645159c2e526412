#pragma once

#include "core/instruction_set.hpp"
#include "physics/crowd/kernel_set.hpp"

namespace lutka::physics::crowd {

// A lane is a doll in each of the sets.
using lutka::bestInstructionSet;
using lutka::hasInstructionSet;
using lutka::InstructionSet;

/// Kernels of a set that is there.
[[nodiscard]] const Kernels& kernelsOf(InstructionSet set);

// Each defined by its own translation unit.
extern const Kernels kBaselineKernels;
extern const Kernels kAvx2Kernels;
extern const Kernels kAvx512Kernels;

}  // namespace lutka::physics::crowd
