#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace nacre {

/// The counts that a shell's compressed data must declare.
struct DracoCounts {
  std::size_t triangles = 0;
  std::size_t vertices = 0;
};

/// Most triangles that `bytes` of compressed data are believed to hold.
///
/// Draco allocates what its header declares before it reads on, so the claim has to be held against
/// something. Surfaces from scans take about a byte a triangle; the flattest conceivable one, a
/// full volume's cap, is under 2^22 triangles or far over a byte per 64.
std::size_t plausible_triangles(std::size_t bytes) noexcept;

/// Looks whether Draco's decoder can be trusted with some compressed data: whether it is laid out
/// as this project's writer lays it out (a mesh of bitstream 2.2, Edgebreaker, one attribute of
/// three floats), with the counts expected.
///
/// Draco's decoder has open reports of crashes and of allocations of gigabytes for a few damaged
/// bytes (google/draco 795, 1167, 1169, 1198, 1221). What they need is closed off here: the
/// sequential method with its unchecked indices, metadata, attribute seams, further attributes
/// (any number of them, each the size of the mesh), and counts beyond those expected.
///
/// @return  what is wrong, as "found ..., expected ..."; nothing if nothing is
/// The cost: decoding the connectivity's symbols once, a small part of decoding the mesh.
std::optional<std::string> draco_objection(std::span<const std::byte> data,
                                           const DracoCounts& expected);

}  // namespace nacre
