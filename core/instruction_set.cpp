#include "core/instruction_set.h"

namespace nacre {

bool has_instruction_set(InstructionSet set) noexcept {
#ifdef NACRE_KERNEL_AVX512
  if (set == InstructionSet::Avx512) {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("bmi") && __builtin_cpu_supports("popcnt");
  }
#endif
#ifdef NACRE_KERNEL_AVX2
  if (set == InstructionSet::Avx2) return __builtin_cpu_supports("avx2");
#endif
  return set == InstructionSet::Baseline;
}

InstructionSet best_instruction_set() noexcept {
  if (has_instruction_set(InstructionSet::Avx512)) return InstructionSet::Avx512;
  if (has_instruction_set(InstructionSet::Avx2)) return InstructionSet::Avx2;
  return InstructionSet::Baseline;
}

}  // namespace nacre
