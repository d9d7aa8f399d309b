#include "casting/sample_kernel.h"

namespace nacre {
namespace samples_baseline {
SampleKernel sample_kernel() noexcept;
}  // namespace samples_baseline
namespace samples_avx2 {
SampleKernel sample_kernel() noexcept;
}  // namespace samples_avx2
namespace samples_avx512 {
SampleKernel sample_kernel() noexcept;
}  // namespace samples_avx512

SampleKernel sample_kernel_for([[maybe_unused]] InstructionSet set) noexcept {
#ifdef NACRE_KERNEL_AVX512
  if (set == InstructionSet::Avx512) return samples_avx512::sample_kernel();
#endif
#ifdef NACRE_KERNEL_AVX2
  if (set != InstructionSet::Baseline) return samples_avx2::sample_kernel();
#endif
  return samples_baseline::sample_kernel();
}

}  // namespace nacre
