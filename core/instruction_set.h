#pragma once

namespace nacre {

/// Instruction sets that kernels are compiled for. A kernel gives the same with each, to the last
/// bit.
enum class InstructionSet {
  Baseline,  ///< what all processors of the architecture have
  Avx2,      ///< x86 only
};

/// The best set that this build has kernels for and this processor has.
InstructionSet best_instruction_set() noexcept;

}  // namespace nacre
