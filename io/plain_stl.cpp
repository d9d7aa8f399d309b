// STL, binary and ASCII, reduced to what OpenMesh reads (see plain_mesh.h).
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "io/bad_file.h"
#include "io/plain_mesh.h"
#include "io/text_lines.h"

namespace nacre {
namespace {

constexpr std::size_t kHeaderSize = 84;    // 80 bytes of anything and the number of triangles
constexpr std::size_t kTriangleSize = 50;  // normal and three corners as floats, 2 bytes of colour
constexpr std::size_t kBytesLookedAt = 1024;

std::string lower_case(std::string_view word) {
  std::string lower(word);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

std::uint32_t counted_triangles(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= kHeaderSize) std::memcpy(&count, bytes.data() + 80, sizeof(count));
  return count;
}

std::size_t binary_size(std::string_view bytes) {
  return kHeaderSize + std::size_t{counted_triangles(bytes)} * kTriangleSize;
}

/// Some programs begin binary files with "solid" as well, so the size decides where it fits.
bool is_ascii(std::string_view bytes) {
  if (bytes.size() >= kHeaderSize && bytes.size() == binary_size(bytes)) return false;
  std::string_view rest = bytes.substr(0, kBytesLookedAt);
  const bool text = std::none_of(rest.begin(), rest.end(),
                                 [](unsigned char c) { return c < ' ' && std::isspace(c) == 0; });
  return text && lower_case(next_word(rest)) == "solid";
}

void check_corners(const std::filesystem::path& path, std::string_view bytes, std::size_t count) {
  for (std::size_t triangle = 0; triangle < count; ++triangle) {
    float corners[9];
    std::memcpy(corners, bytes.data() + kHeaderSize + triangle * kTriangleSize + 12,
                sizeof(corners));
    if (!std::all_of(std::begin(corners), std::end(corners),
                     [](float x) { return std::isfinite(x); })) {
      throw_bad_file(path, fmt::format("NaN or infinity in triangle {}", triangle + 1),
                     "finite vertices");
    }
  }
}

PlainMesh plain_binary(const std::filesystem::path& path, std::string bytes) {
  if (bytes.size() < kHeaderSize) {
    throw_bad_file(path, fmt::format("{} bytes", bytes.size()),
                   "an STL mesh: \"solid\", or 84 bytes of header and 50 for each triangle");
  }
  const std::size_t count = counted_triangles(bytes);
  const std::size_t expected = binary_size(bytes);
  if (bytes.size() < expected) {
    throw_bad_file(path, fmt::format("{} bytes (truncated)", bytes.size()),
                   fmt::format("{} bytes for {} triangles", expected, count));
  }
  const std::size_t beyond = bytes.size() - expected;
  if (beyond > 0 && beyond % kTriangleSize == 0) {
    throw_bad_file(path, fmt::format("a count of {} triangles", count),
                   fmt::format("{}, for which there are bytes", count + beyond / kTriangleSize));
  }
  check_corners(path, bytes, count);
  bytes.resize(expected);
  return {std::move(bytes), true, 0, count};
}

/// Goes through ASCII STL word by word; OpenMesh looks for its keywords anywhere in a line, also in
/// the name of a solid.
class AsciiStl {
 public:
  AsciiStl(const std::filesystem::path& path, std::string_view text) : path_(path), rest_(text) {}

  PlainMesh plain() {
    while (next_is_solid()) read_solid();
    plain_.bytes = "solid\n" + plain_.bytes + "endsolid\n";
    return std::move(plain_);
  }

 private:
  /// After the last solid comes the end, or what is none of this file's business: but no facets.
  bool next_is_solid() {
    for (std::string_view word = next_word(rest_); !word.empty(); word = next_word(rest_)) {
      const std::string lower = lower_case(word);
      if (lower == "solid") {
        skip_line();
        return true;
      }
      if (lower == "facet") refuse(word, "solid before it");
    }
    return false;
  }

  void read_solid() {
    for (;;) {
      const std::string_view word = next_word(rest_);
      if (lower_case(word) == "endsolid") return skip_line();
      if (lower_case(word) != "facet") refuse(word, "facet or endsolid");
      read_facet();
    }
  }

  void read_facet() {
    expect("normal");
    for (int i = 0; i < 3; ++i) next_word(rest_);  // some programs write NaN there
    expect("outer");
    expect("loop");
    plain_.bytes += "outer loop\n";
    for (int i = 0; i < 3; ++i) {
      expect("vertex");
      plain_.bytes += "vertex";
      for (int axis = 0; axis < 3; ++axis) copy_number();
      plain_.bytes += '\n';
    }
    expect("endloop");
    expect("endfacet");
    ++plain_.faces;
  }

  void copy_number() {
    const std::string_view word = next_word(rest_);
    if (!finite_number(word)) refuse(word, "a finite number");
    plain_.bytes += ' ';
    plain_.bytes += word;
  }

  void expect(std::string_view keyword) {
    const std::string_view word = next_word(rest_);
    if (lower_case(word) != keyword) refuse(word, std::string(keyword));
  }

  void skip_line() { rest_.remove_prefix(std::min(rest_.find_first_of("\r\n"), rest_.size())); }

  [[noreturn]] void refuse(std::string_view word, const std::string& expected) const {
    throw_bad_file(path_,
                   word.empty()
                       ? fmt::format("the file's end after {} facets", plain_.faces)
                       : fmt::format("\"{}\" after {} facets", printable(word), plain_.faces),
                   expected);
  }

  const std::filesystem::path& path_;
  std::string_view rest_;
  PlainMesh plain_;
};

}  // namespace

PlainMesh plain_stl(const std::filesystem::path& path, std::string bytes) {
  return is_ascii(bytes) ? AsciiStl(path, bytes).plain() : plain_binary(path, std::move(bytes));
}

}  // namespace nacre
