#include "extract/swept_surfaces.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace nacre {
namespace {

std::size_t byte_count(const SlabOutput& output) {
  std::size_t bytes = 0;
  for (const LevelOutput& level : output.levels) {
    bytes += level.positions.size() * sizeof(glm::vec3);
    bytes += level.triangles.size() * sizeof(glm::uvec3);
  }
  return bytes;
}

}  // namespace

SweptSurfaces::SweptSurfaces(std::size_t slab_count, std::size_t level_count, bool reversed,
                             const SurfaceStorage& storage)
    : slab_count_(slab_count),
      reversed_(reversed),
      memory_bytes_(storage.memory_bytes),
      surfaces_(level_count) {
  if (storage.scratch_folder) scratch_ = ScratchFile::create(*storage.scratch_folder);
}

void SweptSurfaces::append(SlabOutput& output) {
  held_bytes_ += byte_count(output);
  is_storing_ = is_storing_ || (scratch_ && held_bytes_ > memory_bytes_);
  const double share = static_cast<double>(++slabs_) / static_cast<double>(slab_count_);
  // Isolated: a thread that waits for the others must not take up another slab meanwhile.
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, surfaces_.size(), [&](std::size_t k) {
      surfaces_[k].append(output.levels[k], k, reversed_, share, is_storing_ ? file() : nullptr);
    });
  });
}

TriangleMesh SweptSurfaces::take(std::size_t level) { return surfaces_[level].take(file()); }

}  // namespace nacre
