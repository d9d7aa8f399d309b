#include "reference/cell_kernel.h"

#include "reference/cubic.h"

namespace nacre {
namespace cells_baseline {
CellKernel cell_kernel() noexcept;
}  // namespace cells_baseline
namespace cells_avx2 {
CellKernel cell_kernel() noexcept;
}  // namespace cells_avx2

CellKernel cell_kernel_for([[maybe_unused]] InstructionSet set) noexcept {
#ifdef NACRE_KERNEL_AVX2
  if (set != InstructionSet::Baseline) return cells_avx2::cell_kernel();
#endif
  return cells_baseline::cell_kernel();
}

double maximum_of(const CellPart& part) noexcept {
  return maximum({{part.b[0], part.b[1], part.b[2], part.b[3]}});
}

}  // namespace nacre
