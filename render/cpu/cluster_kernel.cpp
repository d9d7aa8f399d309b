#include "render/cpu/cluster_kernel.h"

namespace nacre {
namespace kernel_baseline {
DrawClusters<std::uint8_t> draw_clusters_8() noexcept;
DrawClusters<std::uint16_t> draw_clusters_16() noexcept;
DrawClusters<float> draw_clusters_cued() noexcept;
}  // namespace kernel_baseline
namespace kernel_avx2 {
DrawClusters<std::uint8_t> draw_clusters_8() noexcept;
DrawClusters<std::uint16_t> draw_clusters_16() noexcept;
DrawClusters<float> draw_clusters_cued() noexcept;
}  // namespace kernel_avx2

template <>
DrawClusters<std::uint8_t> draw_clusters_for([[maybe_unused]] InstructionSet set) noexcept {
#ifdef NACRE_KERNEL_AVX2
  if (set == InstructionSet::Avx2) return kernel_avx2::draw_clusters_8();
#endif
  return kernel_baseline::draw_clusters_8();
}

template <>
DrawClusters<std::uint16_t> draw_clusters_for([[maybe_unused]] InstructionSet set) noexcept {
#ifdef NACRE_KERNEL_AVX2
  if (set == InstructionSet::Avx2) return kernel_avx2::draw_clusters_16();
#endif
  return kernel_baseline::draw_clusters_16();
}

template <>
DrawClusters<float> draw_clusters_for([[maybe_unused]] InstructionSet set) noexcept {
#ifdef NACRE_KERNEL_AVX2
  if (set == InstructionSet::Avx2) return kernel_avx2::draw_clusters_cued();
#endif
  return kernel_baseline::draw_clusters_cued();
}

}  // namespace nacre
