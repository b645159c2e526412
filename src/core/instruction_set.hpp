#pragma once

namespace lutka {

/// What wide kernels are compiled for, each choosing at run time what the processor has. What a kernel
/// promises of their bits, it says itself.
enum class InstructionSet {
    baseline,  ///< What every processor of the platform has (x86-64: SSE2, four floats a register).
    avx2,      ///< Eight floats a register, and fused multiply-add.
    avx512,    ///< Its 32 registers; kernels keep eight floats in each.
};

/// The widest that this processor and this build have.
[[nodiscard]] InstructionSet bestInstructionSet();
[[nodiscard]] bool hasInstructionSet(InstructionSet set);

}  // namespace lutka
