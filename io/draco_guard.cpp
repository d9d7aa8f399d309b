#include "io/draco_guard.h"

#include <draco/attributes/geometry_attribute.h>
#include <draco/compression/config/compression_shared.h>
#include <draco/compression/entropy/symbol_decoding.h>
#include <draco/core/decoder_buffer.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

namespace nacre {
namespace {

constexpr std::size_t kAlwaysPlausible = std::size_t{1} << 22;
constexpr std::size_t kTrianglesPerByte = 64;
constexpr std::uint8_t kMajor = 2;
constexpr std::uint8_t kMinor = 2;
constexpr int kValenceContexts = 6;
constexpr std::uint32_t kLastSymbol = 4;  // C, S, L, R, E
constexpr std::uint32_t kMaxAttributeId = 0xFFFF;

using Objection = std::optional<std::string>;

template <class T>
bool next_is(draco::DecoderBuffer& buffer, T expected) {
  T found{};
  return buffer.Decode(&found) && found == expected;
}

std::optional<std::uint32_t> next_count(draco::DecoderBuffer& buffer) {
  std::uint32_t count = 0;
  if (!draco::DecodeVarint(&count, &buffer)) return std::nullopt;
  return count;
}

bool skip(draco::DecoderBuffer& buffer, std::uint64_t bytes) {
  if (bytes > static_cast<std::uint64_t>(buffer.remaining_size())) return false;
  buffer.Advance(static_cast<std::int64_t>(bytes));
  return true;
}

/// "DRACO", version 2.2, a mesh, by Edgebreaker, without metadata.
Objection check_header(draco::DecoderBuffer& buffer) {
  char magic[5];
  if (!buffer.Decode(magic, sizeof(magic)) || std::memcmp(magic, "DRACO", sizeof(magic)) != 0) {
    return "found compressed data without Draco's mark, expected it at its beginning";
  }
  std::uint8_t major = 0;
  std::uint8_t minor = 0;
  if (!buffer.Decode(&major) || !buffer.Decode(&minor) || major != kMajor || minor != kMinor) {
    return fmt::format("found Draco bitstream {}.{}, expected {}.{}", major, minor, kMajor, kMinor);
  }
  if (!next_is(buffer, static_cast<std::uint8_t>(draco::TRIANGULAR_MESH)) ||
      !next_is(buffer, static_cast<std::uint8_t>(draco::MESH_EDGEBREAKER_ENCODING))) {
    return "found another Draco method, expected a mesh by Edgebreaker";
  }
  if (!next_is(buffer, std::uint16_t{0})) {
    return "found Draco flags or metadata, expected none";
  }
  buffer.set_bitstream_version(DRACO_BITSTREAM_VERSION(kMajor, kMinor));
  return std::nullopt;
}

/// The numbers of vertices, faces, other attributes' seams, symbols and split symbols.
Objection check_counts(draco::DecoderBuffer& buffer, const DracoCounts& expected) {
  const auto vertices = next_count(buffer);
  const auto triangles = next_count(buffer);
  if (vertices != expected.vertices || triangles != expected.triangles) {
    return fmt::format(
        "found {} triangles and {} vertices in the compressed data, expected {} and "
        "{}",
        triangles.value_or(0), vertices.value_or(0), expected.triangles, expected.vertices);
  }
  if (!next_is(buffer, std::uint8_t{0})) {
    return "found further attributes in the compressed data, expected positions only";
  }
  const auto symbols = next_count(buffer);
  const auto splits = next_count(buffer);
  if (!symbols || !splits || *symbols > *triangles || *splits > *symbols) {
    return "found impossible counts in the compressed data, expected symbols within triangles";
  }
  return std::nullopt;
}

/// Topology split events: two numbers each, then one bit each.
bool skip_split_events(draco::DecoderBuffer& buffer, std::size_t triangles) {
  const auto events = next_count(buffer);
  if (!events || *events > triangles) return false;
  for (std::uint32_t i = 0; i < *events; ++i) {
    if (!next_count(buffer) || !next_count(buffer)) return false;
  }
  return skip(buffer, (std::uint64_t{*events} + 7) / 8);
}

/// One bit a component, by a binary rANS coder: a probability, a size, that many bytes.
bool skip_start_faces(draco::DecoderBuffer& buffer) {
  std::uint8_t probability = 0;
  if (!buffer.Decode(&probability)) return false;
  const auto size = next_count(buffer);
  return size && skip(buffer, *size);
}

/// Symbols as plain bits, their size in front.
bool skip_plain_symbols(draco::DecoderBuffer& buffer) {
  std::uint64_t size = 0;
  return draco::DecodeVarint(&size, &buffer) && skip(buffer, size);
}

/// Entropy-coded symbols by valence. Their length shows only by decoding them.
bool skip_valence_symbols(draco::DecoderBuffer& buffer, std::size_t triangles) {
  std::vector<std::uint32_t> symbols;
  for (int context = 0; context < kValenceContexts; ++context) {
    const auto count = next_count(buffer);
    if (!count || *count > triangles) return false;
    if (*count == 0) continue;
    symbols.resize(*count);
    if (!draco::DecodeSymbols(*count, 1, &buffer, symbols.data())) return false;
    if (*std::max_element(symbols.begin(), symbols.end()) > kLastSymbol) return false;
  }
  return true;
}

Objection check_connectivity(draco::DecoderBuffer& buffer, std::uint8_t traversal,
                             std::size_t triangles) {
  const bool valence = traversal == draco::MESH_EDGEBREAKER_VALENCE_ENCODING;
  if (!valence && traversal != draco::MESH_EDGEBREAKER_STANDARD_ENCODING) {
    return "found an unknown Edgebreaker traversal, expected the standard or the valence one";
  }
  const bool passes = skip_split_events(buffer, triangles) &&
                      (valence || skip_plain_symbols(buffer)) && skip_start_faces(buffer) &&
                      (!valence || skip_valence_symbols(buffer, triangles));
  if (!passes) return "found damaged connectivity in the compressed data, expected it whole";
  return std::nullopt;
}

/// One group of attributes, with one attribute: three floats a vertex, the position.
Objection check_attributes(draco::DecoderBuffer& buffer) {
  std::uint8_t traversal = 0;
  const bool one_group = next_is(buffer, std::uint8_t{1}) &&  // groups
                         next_is(buffer, std::int8_t{-1}) &&  // not one with seams
                         next_is(buffer, std::uint8_t{draco::MESH_VERTEX_ATTRIBUTE}) &&
                         buffer.Decode(&traversal);
  const bool positions = one_group && next_count(buffer) == 1u &&
                         next_is(buffer, std::uint8_t{draco::GeometryAttribute::POSITION}) &&
                         next_is(buffer, std::uint8_t{draco::DT_FLOAT32}) &&
                         next_is(buffer, std::uint8_t{3}) && next_is(buffer, std::uint8_t{0});
  if (!positions) {
    return "found other attributes in the compressed data, expected one of three floats";
  }
  const auto id = next_count(buffer);
  if (!id || *id > kMaxAttributeId) return "found a damaged attribute, expected its number";
  return std::nullopt;
}

}  // namespace

std::size_t plausible_triangles(std::size_t bytes) noexcept {
  return std::max(kAlwaysPlausible, bytes * kTrianglesPerByte);
}

std::optional<std::string> draco_objection(std::span<const std::byte> data,
                                           const DracoCounts& expected) {
  if (expected.triangles > plausible_triangles(data.size()) ||
      expected.vertices > 3 * expected.triangles) {
    return fmt::format(
        "found {} triangles and {} vertices in {} bytes, expected at most {} "
        "triangles",
        expected.triangles, expected.vertices, data.size(), plausible_triangles(data.size()));
  }
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(data.data()), data.size());
  if (auto objection = check_header(buffer)) return objection;
  std::uint8_t traversal = 0;
  if (!buffer.Decode(&traversal)) return "found compressed data cut short, expected it whole";
  if (auto objection = check_counts(buffer, expected)) return objection;
  if (auto objection = check_connectivity(buffer, traversal, expected.triangles)) return objection;
  return check_attributes(buffer);
}

}  // namespace nacre
