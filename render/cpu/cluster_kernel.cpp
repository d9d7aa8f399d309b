#include "render/cpu/cluster_kernel.h"

#include <bit>

namespace nacre {
namespace {

constexpr std::uint32_t kSign = 0x80000000U;

/// The bits of floats as whole numbers of the same order.
std::uint32_t ordered(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

float value_of(std::uint32_t ordered_bits) {
  return std::bit_cast<float>((ordered_bits & kSign) != 0 ? ordered_bits & ~kSign : ~ordered_bits);
}

}  // namespace

std::uint64_t key_of(const NearestKey& nearest) noexcept {
  return std::uint64_t{~ordered(nearest.depth_mm)} << 32U | std::uint32_t{~nearest.triangle};
}

NearestKey nearest_of(std::uint64_t key) noexcept {
  return {value_of(~static_cast<std::uint32_t>(key >> 32U)), ~static_cast<std::uint32_t>(key)};
}

namespace kernel_baseline {
template <class Pixel>
DrawClusters<Pixel> draw_clusters_of() noexcept;
}  // namespace kernel_baseline
namespace kernel_avx2 {
template <class Pixel>
DrawClusters<Pixel> draw_clusters_of() noexcept;
}  // namespace kernel_avx2
namespace kernel_avx512 {
template <class Pixel>
DrawClusters<Pixel> draw_clusters_of() noexcept;
}  // namespace kernel_avx512

template <class Pixel>
DrawClusters<Pixel> draw_clusters_for([[maybe_unused]] InstructionSet set) noexcept {
#ifdef NACRE_KERNEL_AVX512
  if (set == InstructionSet::Avx512) return kernel_avx512::draw_clusters_of<Pixel>();
#endif
#ifdef NACRE_KERNEL_AVX2
  if (set == InstructionSet::Avx2) return kernel_avx2::draw_clusters_of<Pixel>();
#endif
  return kernel_baseline::draw_clusters_of<Pixel>();
}

template DrawClusters<std::uint8_t> draw_clusters_for(InstructionSet set) noexcept;
template DrawClusters<std::uint16_t> draw_clusters_for(InstructionSet set) noexcept;
template DrawClusters<float> draw_clusters_for(InstructionSet set) noexcept;
template DrawClusters<std::int32_t> draw_clusters_for(InstructionSet set) noexcept;
template DrawClusters<std::int64_t> draw_clusters_for(InstructionSet set) noexcept;
template DrawClusters<std::uint64_t> draw_clusters_for(InstructionSet set) noexcept;

}  // namespace nacre
