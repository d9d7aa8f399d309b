#include "core/instruction_set.h"

namespace nacre {

InstructionSet best_instruction_set() noexcept {
#ifdef NACRE_KERNEL_AVX2
  if (__builtin_cpu_supports("avx2")) return InstructionSet::Avx2;
#endif
  return InstructionSet::Baseline;
}

}  // namespace nacre
