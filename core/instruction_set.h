#pragma once

namespace nacre {

/// Instruction sets that kernels are compiled for. A kernel gives the same with each, to the last
/// bit; one that is not compiled for a set takes the best before it.
enum class InstructionSet {
  Baseline,  ///< what all processors of the architecture have
  Avx2,      ///< x86 only
  Avx512,    ///< x86 only: AVX-512 F, BW, DQ and VL, and what comes with them: BMI, POPCNT
};

/// Whether this build has kernels for the set and this processor has it.
bool has_instruction_set(InstructionSet set) noexcept;

/// The best of these.
InstructionSet best_instruction_set() noexcept;

}  // namespace nacre
