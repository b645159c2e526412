#pragma once

#include "physics/crowd/layout.hpp"

namespace lutka::physics::crowd {

/// What the kernels are compiled for. All give the same bits; a lane is a doll in each of them.
enum class InstructionSet {
    baseline,  ///< What every processor of the platform has (x86-64: SSE2, two registers a Wide).
    avx2,      ///< One register a Wide.
    avx512,    ///< The same with twice as many registers.
};

/// The widest that this processor and this build have.
[[nodiscard]] InstructionSet bestInstructionSet();
[[nodiscard]] bool hasInstructionSet(InstructionSet set);

/// Kernels of a set that is there.
[[nodiscard]] const Kernels& kernelsOf(InstructionSet set);

// Each defined by its own translation unit.
extern const Kernels kBaselineKernels;
extern const Kernels kAvx2Kernels;
extern const Kernels kAvx512Kernels;

}  // namespace lutka::physics::crowd
