#include "shells/voxel_checksum.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>
#include <vector>

#include "core/checksum.h"

namespace nacre {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20;

}  // namespace

std::uint64_t voxel_checksum(const Volume& volume) {
  const std::span<const std::byte> bytes(volume.samples.data(), volume.samples.size());
  std::vector<std::uint64_t> blocks((bytes.size() + kBlock - 1) / kBlock);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
    blocks[i] = xxh64(bytes.subspan(i * kBlock, std::min(kBlock, bytes.size() - i * kBlock)));
  });
  return xxh64(std::as_bytes(std::span(blocks)), bytes.size());
}

}  // namespace nacre
