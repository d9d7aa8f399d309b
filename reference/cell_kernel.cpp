#include "reference/cell_kernel.h"

#include "reference/cubic.h"

namespace nacre {
namespace cells_baseline {
CellKernel cell_kernel() noexcept;
}  // namespace cells_baseline
namespace cells_avx2 {
CellKernel cell_kernel() noexcept;
}  // namespace cells_avx2

CellKernelSet best_cell_kernel_set() noexcept {
#ifdef NACRE_KERNEL_AVX2
  if (__builtin_cpu_supports("avx2")) return CellKernelSet::Avx2;
#endif
  return CellKernelSet::Baseline;
}

CellKernel cell_kernel_for([[maybe_unused]] CellKernelSet set) noexcept {
#ifdef NACRE_KERNEL_AVX2
  if (set == CellKernelSet::Avx2) return cells_avx2::cell_kernel();
#endif
  return cells_baseline::cell_kernel();
}

double maximum_of(const CellPart& part) noexcept {
  return maximum({{part.b[0], part.b[1], part.b[2], part.b[3]}});
}

}  // namespace nacre
