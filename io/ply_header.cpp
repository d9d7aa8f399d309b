#include "io/ply_header.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "io/bad_file.h"
#include "io/text_lines.h"

namespace nacre {
namespace {

constexpr std::array<PlyType, 16> kTypes{{
    {"char", 1, false, true},
    {"int8", 1, false, true},
    {"uchar", 1, false, false},
    {"uint8", 1, false, false},
    {"short", 2, false, true},
    {"int16", 2, false, true},
    {"ushort", 2, false, false},
    {"uint16", 2, false, false},
    {"int", 4, false, true},
    {"int32", 4, false, true},
    {"uint", 4, false, false},
    {"uint32", 4, false, false},
    {"float", 4, true, true},
    {"float32", 4, true, true},
    {"double", 8, true, true},
    {"float64", 8, true, true},
}};

class HeaderLines {
 public:
  HeaderLines(const std::filesystem::path& path, std::string_view bytes)
      : path_(path), lines_(bytes) {}

  PlyHeader read() {
    if (!lines_.next() || (lines_.line() != "ply" && lines_.line() != "PLY")) {
      throw_bad_file(path_, fmt::format("\"{}\"", printable(lines_.line().substr(0, 20))),
                     "\"ply\" at the beginning of a PLY file");
    }
    read_encoding();
    while (next_statement()) read_statement();
    for (const PlyElement& element : header_.elements) {
      if (element.count > 0 && element.properties.empty()) {
        throw_bad_file(path_, fmt::format("elements \"{}\" without properties", element.name),
                       "at least one");
      }
    }
    header_.body_offset = lines_.offset();
    return std::move(header_);
  }

 private:
  /// Moves on, over comments; false at the header's end.
  bool next_statement() {
    do {
      if (!lines_.next()) throw_bad_file(path_, "no end_header", "a whole PLY header");
      split_words(lines_.line(), words_);
    } while (words_.empty() || words_[0] == "comment" || words_[0] == "obj_info");
    return words_[0] != "end_header";
  }

  void read_encoding() {
    next_statement();
    if (words_.size() != 3 || words_[0] != "format") refuse("format ... 1.0");
    if (words_[1] == "ascii") {
      header_.encoding = PlyEncoding::Ascii;
    } else if (words_[1] == "binary_little_endian") {
      header_.encoding = PlyEncoding::LittleEndian;
    } else if (words_[1] == "binary_big_endian") {
      header_.encoding = PlyEncoding::BigEndian;
    } else {
      refuse("format ascii, binary_little_endian or binary_big_endian");
    }
  }

  void read_statement() {
    if (words_[0] == "element" && words_.size() == 3) {
      read_element();
    } else if (words_[0] == "property" && words_.size() == 3) {
      add_property({std::string(words_[2]), type(words_[1]), std::nullopt});
    } else if (words_[0] == "property" && words_.size() == 5 && words_[1] == "list") {
      const PlyType count_type = type(words_[2]);
      if (count_type.is_float) refuse("a whole number as a list's length");
      add_property({std::string(words_[4]), type(words_[3]), count_type});
    } else {
      refuse("element, property, comment or end_header");
    }
  }

  void read_element() {
    const auto count = whole_number(words_[2]);
    if (!count || *count < 0) refuse("element NAME COUNT");
    for (const PlyElement& other : header_.elements) {
      if (other.name == words_[1]) refuse("each element once");
    }
    header_.elements.push_back({std::string(words_[1]), static_cast<std::uint64_t>(*count), {}});
  }

  void add_property(PlyProperty property) {
    if (header_.elements.empty()) refuse("an element before its properties");
    std::vector<PlyProperty>& properties = header_.elements.back().properties;
    for (const PlyProperty& other : properties) {
      if (other.name == property.name) refuse("each property once");
    }
    properties.push_back(std::move(property));
  }

  PlyType type(std::string_view name) const {
    for (const PlyType& known : kTypes) {
      if (known.name == name) return known;
    }
    refuse("a PLY number type");
  }

  [[noreturn]] void refuse(const std::string& expected) const {
    throw_bad_file(path_,
                   fmt::format("\"{}\" in line {}", printable(lines_.line()), lines_.number()),
                   expected);
  }

  const std::filesystem::path& path_;
  TextLines lines_;
  std::vector<std::string_view> words_;
  PlyHeader header_;
};

}  // namespace

PlyHeader read_ply_header(const std::filesystem::path& path, std::string_view bytes) {
  return HeaderLines(path, bytes).read();
}

}  // namespace nacre
