#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nacre {

/// A number type of a PLY file.
struct PlyType {
  std::string_view name;  ///< "uchar"
  std::size_t size = 0;   ///< bytes, in binary files
  bool is_float = false;
  bool is_signed = false;
};

/// A property of an element: a number, or a list of them.
struct PlyProperty {
  std::string name;
  PlyType type;
  std::optional<PlyType> count_type;  ///< of a list's length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  ///< as claimed, not as found
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { Ascii, LittleEndian, BigEndian };

/// What a PLY file says of itself before its data.
struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> elements;
  std::size_t body_offset = 0;  ///< of the first byte of data
};

/// @throws Error  BadFile unless the bytes begin with a whole header in which every element has
///                properties and every name stands once
PlyHeader read_ply_header(const std::filesystem::path& path, std::string_view bytes);

}  // namespace nacre
