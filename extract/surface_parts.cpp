#include "extract/surface_parts.h"

#include <algorithm>
#include <span>
#include <utility>

namespace nacre {
namespace {

std::size_t byte_count(const std::vector<PartSizes>& levels) {
  std::size_t bytes = 0;
  for (const PartSizes& sizes : levels) {
    bytes += (sizes.vertices - sizes.shared_count) * sizeof(glm::vec3);
    bytes += sizes.triangles * sizeof(glm::uvec3);
  }
  return bytes;
}

/// Room for `count` more elements at the end.
template <class Element>
std::span<Element> grow(std::vector<Element>& elements, std::size_t count) {
  elements.resize(elements.size() + count);
  return std::span(elements).last(count);
}

/// Writes a stream to a file in one piece.
/// @return  where it begins; none where it cannot be written
template <class Element>
std::optional<std::uint64_t> write_all(ChunkedStream<Element>& stream, ScratchFile& file) {
  const std::uint64_t begin = file.reserve(stream.size() * sizeof(Element));
  std::uint64_t offset = begin;
  bool is_written = true;
  stream.for_each_chunk([&](std::span<Element> chunk) {
    is_written = is_written && file.write(offset, std::as_bytes(chunk));
    offset += chunk.size_bytes();
  });
  return is_written ? std::optional(begin) : std::nullopt;
}

}  // namespace

SurfaceParts::SurfaceParts(std::size_t slab_count, std::size_t level_count, bool reversed,
                           const SurfaceStorage& storage)
    : reversed_(reversed),
      memory_bytes_(storage.memory_bytes),
      parts_(slab_count),
      joined_(level_count) {
  if (storage.scratch_folder) scratch_ = ScratchFile::create(*storage.scratch_folder);
}

void SurfaceParts::put(std::size_t slab, SlabOutput output) {
  Part& part = parts_[slab];
  for (const LevelOutput& level : output.levels) part.sizes.push_back(sizes_of(level));
  const std::size_t bytes = byte_count(part.sizes);
  if (scratch_ && held_bytes_ + bytes > memory_bytes_ && store(output, part.places)) return;
  held_bytes_ += bytes;
  part.output = std::move(output);
}

bool SurfaceParts::store(SlabOutput& output, std::vector<Place>& places) {
  for (LevelOutput& level : output.levels) {
    const std::optional<Place> place = store(level);
    if (!place) {
      places.clear();
      return false;
    }
    places.push_back(*place);
  }
  return true;
}

std::optional<SurfaceParts::Place> SurfaceParts::store(LevelOutput& output) {
  const auto positions = write_all(output.positions, *scratch_);
  const auto triangles = write_all(output.triangles, *scratch_);
  if (!positions || !triangles) return std::nullopt;
  return Place{*positions, *triangles};
}

void SurfaceParts::settle() {
  const auto is_stored = [](const Part& part) { return !part.places.empty(); };
  if (std::any_of(parts_.begin(), parts_.end(), is_stored)) return;
  std::vector<SlabOutput> outputs;
  for (Part& part : parts_) outputs.push_back(std::move(part.output));
  merge_slabs(outputs, reversed_, joined_);
  is_joined_ = true;
}

std::size_t SurfaceParts::triangle_count(std::size_t level) const {
  std::size_t count = 0;
  for (const Part& part : parts_) count += part.sizes[level].triangles;
  return count;
}

void SurfaceParts::append(Part& part, std::size_t level, const Renumbering& renumbering,
                          TriangleMesh& mesh) {
  if (part.places.empty()) {
    append_positions(part.output.levels[level], mesh.positions);
    append_triangles(part.output.levels[level], renumbering, reversed_, mesh.triangles);
    return;
  }
  const PartSizes& sizes = part.sizes[level];
  const auto positions = grow(mesh.positions, sizes.vertices - sizes.shared_count);
  scratch_->read(part.places[level].positions, std::as_writable_bytes(positions));
  const auto triangles = grow(mesh.triangles, sizes.triangles);
  scratch_->read(part.places[level].triangles, std::as_writable_bytes(triangles));
  renumber(triangles, renumbering, reversed_);
}

TriangleMesh SurfaceParts::take(std::size_t level) {
  if (is_joined_) return std::exchange(joined_[level], {});
  std::vector<PartSizes> sizes;
  for (const Part& part : parts_) sizes.push_back(part.sizes[level]);
  const MergePlan plan = plan_merge(sizes, level);
  TriangleMesh mesh;
  mesh.positions.reserve(plan.vertices);
  mesh.triangles.reserve(plan.triangles);
  for (std::size_t s = 0; s < parts_.size(); ++s) {
    if (sizes[s].triangles > 0 || sizes[s].vertices > 0) {
      append(parts_[s], level, plan.parts[s], mesh);
    }
  }
  return mesh;
}

}  // namespace nacre
