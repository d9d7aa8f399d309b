// PLY, ASCII and binary, reduced to what OpenMesh reads (see plain_mesh.h).
#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "io/bad_file.h"
#include "io/plain_mesh.h"
#include "io/ply_header.h"
#include "io/text_lines.h"

namespace nacre {
namespace {

static_assert(std::endian::native == std::endian::little);

/// Takes numbers off the data of a PLY file, as they are written there.
class PlyBody {
 public:
  PlyBody(std::string_view body, PlyEncoding encoding) : rest_(body), encoding_(encoding) {}

  /// A word, or the bytes of a number; empty at the end.
  std::string_view take(const PlyType& type) {
    if (encoding_ == PlyEncoding::Ascii) return next_word(rest_);
    const std::string_view number = rest_.substr(0, type.size);
    rest_.remove_prefix(number.size());
    return number.size() == type.size ? number : std::string_view{};
  }

  /// The value of what was taken as a whole number.
  std::optional<long long> whole(std::string_view taken, const PlyType& type) const {
    if (encoding_ == PlyEncoding::Ascii) return whole_number(taken);
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < taken.size(); ++i) {
      const std::size_t at = encoding_ == PlyEncoding::BigEndian ? i : taken.size() - 1 - i;
      bits = bits << 8 | static_cast<unsigned char>(taken[at]);
    }
    const std::uint64_t sign = std::uint64_t{1} << (8 * type.size - 1);
    if (type.is_signed && (bits & sign) != 0) bits -= 2 * sign;
    return static_cast<long long>(bits);
  }

  /// A list's length as OpenMesh is to read it, of type int.
  std::string length(long long count) const {
    if (encoding_ == PlyEncoding::Ascii) return fmt::format("{}", count);
    std::string bytes(4, '\0');
    const auto narrow = static_cast<std::int32_t>(count);
    std::memcpy(bytes.data(), &narrow, sizeof(narrow));
    if (encoding_ == PlyEncoding::BigEndian) std::reverse(bytes.begin(), bytes.end());
    return bytes;
  }

  std::size_t bytes_left() const { return rest_.size(); }
  bool ascii() const { return encoding_ == PlyEncoding::Ascii; }

 private:
  std::string_view rest_;
  PlyEncoding encoding_;
};

bool is_position(const PlyProperty& property) {
  return !property.count_type &&
         (property.name == "x" || property.name == "y" || property.name == "z");
}

bool is_face_list(const PlyProperty& property) {
  return property.count_type &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// Copies what is kept of one kind of element, and goes over the rest.
class ElementCopier {
 public:
  ElementCopier(const std::filesystem::path& path, const PlyElement& element, PlyBody& body)
      : path_(path), element_(element), body_(body) {}

  /// @param kept  says which properties are copied
  template <class Kept>
  std::string copy(Kept kept) {
    std::string copied;
    for (; done_ < element_.count; ++done_) {
      for (const PlyProperty& property : element_.properties) {
        std::string* into = kept(property) ? &copied : nullptr;
        if (property.count_type) {
          copy_list(property, into);
        } else {
          copy_number(property.type, into);
        }
      }
      if (body_.ascii() && !copied.empty()) copied += '\n';
    }
    return copied;
  }

 private:
  void copy_list(const PlyProperty& property, std::string* into) {
    const std::string_view taken = take(*property.count_type);
    const auto count = body_.whole(taken, *property.count_type);
    // Every entry takes a byte at least.
    if (!count || *count < 0 || static_cast<std::uint64_t>(*count) > body_.bytes_left()) {
      throw_bad_file(path_,
                     fmt::format("a list of {} entries in {} {}",
                                 count ? fmt::format("{}", *count) : printable(taken),
                                 element_.name, done_ + 1),
                     "one that fits the file");
    }
    if (into != nullptr) *into += body_.length(*count);
    if (into != nullptr && body_.ascii()) *into += ' ';
    for (long long i = 0; i < *count; ++i) copy_number(property.type, into);
  }

  void copy_number(const PlyType& type, std::string* into) {
    const std::string_view taken = take(type);
    if (into == nullptr) return;
    if (body_.ascii() &&
        !(type.is_float ? finite_number(taken).has_value() : whole_number(taken).has_value())) {
      throw_bad_file(path_,
                     fmt::format("\"{}\" in {} {}", printable(taken), element_.name, done_ + 1),
                     type.is_float ? "a finite number" : "a whole number");
    }
    *into += taken;
    if (body_.ascii()) *into += ' ';
  }

  std::string_view take(const PlyType& type) {
    const std::string_view taken = body_.take(type);
    if (taken.empty()) {
      throw_bad_file(path_, fmt::format("{} of \"{}\" (truncated)", done_, element_.name),
                     fmt::format("{}, as its header says", element_.count));
    }
    return taken;
  }

  const std::filesystem::path& path_;
  const PlyElement& element_;
  PlyBody& body_;
  std::uint64_t done_ = 0;
};

void check_vertex(const std::filesystem::path& path, const PlyElement& element) {
  const auto positions =
      std::count_if(element.properties.begin(), element.properties.end(), is_position);
  if (positions != 3) {
    throw_bad_file(path, fmt::format("{} of the vertex properties x, y, z", positions),
                   "all three");
  }
  for (const PlyProperty& property : element.properties) {
    if (is_position(property) && !property.type.is_float) {
      throw_bad_file(path, fmt::format("positions of type {}", property.type.name),
                     "float or double");
    }
  }
}

void check_face(const std::filesystem::path& path, const PlyElement& element) {
  const auto lists =
      std::count_if(element.properties.begin(), element.properties.end(), is_face_list);
  if (lists != 1) {
    throw_bad_file(path, fmt::format("{} lists vertex_indices in the element face", lists), "one");
  }
  for (const PlyProperty& property : element.properties) {
    if (is_face_list(property) && property.type.is_float) {
      throw_bad_file(path, fmt::format("vertex indices of type {}", property.type.name),
                     "whole numbers");
    }
  }
}

std::string plain_header(const PlyHeader& header, const PlyElement& vertex,
                         const PlyElement& face) {
  const std::string_view encoding = header.encoding == PlyEncoding::Ascii ? "ascii"
                                    : header.encoding == PlyEncoding::LittleEndian
                                        ? "binary_little_endian"
                                        : "binary_big_endian";
  std::string text = fmt::format("ply\nformat {} 1.0\nelement vertex {}\n", encoding, vertex.count);
  for (const PlyProperty& property : vertex.properties) {
    if (is_position(property)) {
      text += fmt::format("property {} {}\n", property.type.name, property.name);
    }
  }
  text += fmt::format("element face {}\n", face.count);
  for (const PlyProperty& property : face.properties) {
    if (is_face_list(property)) {
      text += fmt::format("property list int {} vertex_indices\n", property.type.name);
    }
  }
  return text + "end_header\n";
}

const PlyElement& element_of(const std::filesystem::path& path, const PlyHeader& header,
                             std::string_view name) {
  for (const PlyElement& element : header.elements) {
    if (element.name == name) return element;
  }
  throw_bad_file(path, fmt::format("no element \"{}\"", name), "a mesh of vertex and face");
}

}  // namespace

PlainMesh plain_ply(const std::filesystem::path& path, std::string_view bytes) {
  const PlyHeader header = read_ply_header(path, bytes);
  const PlyElement& vertex = element_of(path, header, "vertex");
  const PlyElement& face = element_of(path, header, "face");
  check_vertex(path, vertex);
  check_face(path, face);
  PlyBody body(bytes.substr(header.body_offset), header.encoding);
  std::string vertices;
  std::string faces;
  for (const PlyElement& element : header.elements) {
    ElementCopier copier(path, element, body);
    if (&element == &vertex) {
      vertices = copier.copy(is_position);
    } else if (&element == &face) {
      faces = copier.copy(is_face_list);
    } else {
      copier.copy([](const PlyProperty&) { return false; });
    }
  }
  return {plain_header(header, vertex, face) + vertices + faces,
          header.encoding != PlyEncoding::Ascii, static_cast<std::size_t>(vertex.count),
          static_cast<std::size_t>(face.count)};
}

}  // namespace nacre
