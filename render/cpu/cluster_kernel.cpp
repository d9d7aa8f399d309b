#include "render/cpu/cluster_kernel.h"

#include <type_traits>

namespace nacre {
namespace kernel_baseline {
DrawClusters<std::uint8_t> draw_clusters_8() noexcept;
DrawClusters<std::uint16_t> draw_clusters_16() noexcept;
}  // namespace kernel_baseline
namespace kernel_avx2 {
DrawClusters<std::uint8_t> draw_clusters_8() noexcept;
DrawClusters<std::uint16_t> draw_clusters_16() noexcept;
}  // namespace kernel_avx2

InstructionSet best_instruction_set() noexcept {
#ifdef NACRE_KERNEL_AVX2
  if (__builtin_cpu_supports("avx2")) return InstructionSet::Avx2;
#endif
  return InstructionSet::Baseline;
}

template <class Rank>
DrawClusters<Rank> draw_clusters_for([[maybe_unused]] InstructionSet set) noexcept {
  constexpr bool kBytes = std::is_same_v<Rank, std::uint8_t>;
#ifdef NACRE_KERNEL_AVX2
  if (set == InstructionSet::Avx2) {
    if constexpr (kBytes) {
      return kernel_avx2::draw_clusters_8();
    } else {
      return kernel_avx2::draw_clusters_16();
    }
  }
#endif
  if constexpr (kBytes) {
    return kernel_baseline::draw_clusters_8();
  } else {
    return kernel_baseline::draw_clusters_16();
  }
}

template DrawClusters<std::uint8_t> draw_clusters_for<std::uint8_t>(InstructionSet) noexcept;
template DrawClusters<std::uint16_t> draw_clusters_for<std::uint16_t>(InstructionSet) noexcept;

}  // namespace nacre
