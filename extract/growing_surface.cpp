#include "extract/growing_surface.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "core/error.h"

namespace nacre {
namespace {

/// Room for more elements, at once for those that the slabs to come may add: what is not used is
/// never touched, so that it costs addresses (up to four times those needed), not memory.
template <class Element>
void make_room(std::vector<Element>& elements, std::size_t count, double share) {
  const std::size_t needed = elements.size() + count;
  if (needed <= elements.capacity()) return;
  const auto expected = static_cast<std::size_t>(1.1 * static_cast<double>(needed) / share);
  elements.reserve(std::clamp(expected, needed + needed / 2, 4 * needed));
}

template <class Element>
void append_all(ChunkedStream<Element>& stream, double share, std::vector<Element>& elements) {
  make_room(elements, stream.size(), share);
  stream.for_each_chunk([&elements](std::span<const Element> chunk) {
    elements.insert(elements.end(), chunk.begin(), chunk.end());
  });
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

template <class Element>
void read_more(const ScratchFile& file, std::uint64_t offset, std::size_t count,
               std::vector<Element>& elements) {
  elements.resize(elements.size() + count);
  file.read(offset, std::as_writable_bytes(std::span(elements).last(count)));
}

}  // namespace

/// Gives a part's triangles their numbers in the whole surface.
void GrowingSurface::renumber(LevelOutput& part, std::size_t level, bool reversed) {
  const std::uint64_t own_begin = vertices_ - part.shared_count;
  const auto shared_count = static_cast<std::uint32_t>(part.shared_count);
  const auto shared_offset = static_cast<std::uint32_t>(top_begin_);
  const auto own_offset = static_cast<std::uint32_t>(own_begin);
  top_begin_ = own_begin + part.top_begin;
  vertices_ = own_begin + part.next_vertex;
  if (vertices_ > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::Unsupported,
                fmt::format("surface of level {}: found {} vertices, expected at most 2^32 - 1",
                            level + 1, vertices_));
  }
  part.triangles.for_each_chunk([&](std::span<glm::uvec3> chunk) {
    for (glm::uvec3& triangle : chunk) {
      for (int i = 0; i < 3; ++i) {
        triangle[i] += triangle[i] < shared_count ? shared_offset : own_offset;
      }
      if (reversed) std::swap(triangle.y, triangle.z);
    }
  });
}

void GrowingSurface::append(LevelOutput& part, std::size_t level, bool reversed, double share,
                            ScratchFile* file) {
  renumber(part, level, reversed);
  triangles_ += part.triangles.size();
  if (file != nullptr && !is_disk_full_ && store(part, *file)) return;
  TriangleMesh& mesh = places_.empty() ? head_ : tail_;
  append_all(part.positions, share, mesh.positions);
  append_all(part.triangles, share, mesh.triangles);
}

bool GrowingSurface::store(LevelOutput& part, ScratchFile& file) {
  const auto positions = write_all(part.positions, file);
  const auto triangles = write_all(part.triangles, file);
  is_disk_full_ = !positions || !triangles;
  if (is_disk_full_) return false;
  places_.push_back({*positions, *triangles, part.positions.size(), part.triangles.size()});
  return true;
}

TriangleMesh GrowingSurface::take(const ScratchFile* file) {
  TriangleMesh mesh = std::exchange(head_, {});
  if (places_.empty()) return mesh;
  mesh.positions.reserve(static_cast<std::size_t>(vertices_));
  mesh.triangles.reserve(triangles_);
  for (const Place& place : places_) {
    read_more(*file, place.positions, place.position_count, mesh.positions);
    read_more(*file, place.triangles, place.triangle_count, mesh.triangles);
  }
  const TriangleMesh tail = std::exchange(tail_, {});
  mesh.positions.insert(mesh.positions.end(), tail.positions.begin(), tail.positions.end());
  mesh.triangles.insert(mesh.triangles.end(), tail.triangles.begin(), tail.triangles.end());
  return mesh;
}

}  // namespace nacre
