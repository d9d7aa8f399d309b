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

/// 6 kB: they stay in the nearest cache beside what they are copied to.
constexpr std::size_t kTrianglesAtATime = 512;

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

GrowingSurface::Numbering GrowingSurface::number(const LevelOutput& part, std::size_t level,
                                                 bool reversed) {
  const std::uint64_t own_begin = vertices_ - part.shared_count;
  const Numbering numbering{.shared_count = static_cast<std::uint32_t>(part.shared_count),
                            .shared_offset = static_cast<std::uint32_t>(top_begin_),
                            .own_offset = static_cast<std::uint32_t>(own_begin),
                            .reversed = reversed};
  top_begin_ = own_begin + part.top_begin;
  vertices_ = own_begin + part.next_vertex;
  if (vertices_ > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::Unsupported,
                fmt::format("surface of level {}: found {} vertices, expected at most 2^32 - 1",
                            level + 1, vertices_));
  }
  return numbering;
}

void GrowingSurface::renumber(std::span<glm::uvec3> triangles, const Numbering& numbering) {
  if (triangles.empty()) return;
  const auto [shared_count, shared_offset, own_offset, reversed] = numbering;
  const std::uint32_t shared_not_own = shared_offset - own_offset;
  // As plain numbers, which the compiler takes several at a time.
  static_assert(sizeof(glm::uvec3) == 3 * sizeof(std::uint32_t));
  for (std::uint32_t& number : std::span(&triangles.front().x, 3 * triangles.size())) {
    number += own_offset + (number < shared_count ? shared_not_own : 0);
  }
  if (!reversed) return;
  for (glm::uvec3& triangle : triangles) std::swap(triangle.y, triangle.z);
}

/// Some at a time, so that they are copied while they are near.
void GrowingSurface::append_triangles(ChunkedStream<glm::uvec3>& stream, const Numbering& numbering,
                                      double share, std::vector<glm::uvec3>& triangles) {
  make_room(triangles, stream.size(), share);
  stream.for_each_chunk([&](std::span<glm::uvec3> chunk) {
    for (std::size_t begin = 0; begin < chunk.size(); begin += kTrianglesAtATime) {
      const auto some = chunk.subspan(begin, std::min(kTrianglesAtATime, chunk.size() - begin));
      renumber(some, numbering);
      triangles.insert(triangles.end(), some.begin(), some.end());
    }
  });
}

void GrowingSurface::append(LevelOutput& part, std::size_t level, bool reversed, double share,
                            ScratchFile* file) {
  Numbering numbering = number(part, level, reversed);
  triangles_ += part.triangles.size();
  if (file != nullptr && !is_disk_full_) {
    part.triangles.for_each_chunk([&](std::span<glm::uvec3> chunk) { renumber(chunk, numbering); });
    if (store(part, *file)) return;
    numbering = {};  // its triangles have their numbers
  }
  TriangleMesh& mesh = places_.empty() ? head_ : tail_;
  append_all(part.positions, share, mesh.positions);
  append_triangles(part.triangles, numbering, share, mesh.triangles);
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
