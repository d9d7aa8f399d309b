// Wavefront OBJ reduced to what OpenMesh reads (see plain_mesh.h).
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <vector>

#include "io/bad_file.h"
#include "io/plain_mesh.h"
#include "io/text_lines.h"

namespace nacre {
namespace {

// Everything the format knows beside v and f: texture and normals, curves, groups, materials.
constexpr std::array<std::string_view, 43> kDropped{
    "vt",    "vn",    "vp",     "vc",         "p",         "l",        "g",      "o",
    "s",     "mg",    "usemtl", "mtllib",     "usemap",    "maplib",   "cstype", "deg",
    "bmat",  "step",  "curv",   "curv2",      "surf",      "parm",     "trim",   "hole",
    "scrv",  "sp",    "end",    "con",        "bevel",     "c_interp", "lod",    "d_interp",
    "ctech", "stech", "res",    "shadow_obj", "trace_obj", "call",     "csh",    "bsp",
    "bzp",   "cdc",   "cdp"};

/// A line that ends in a backslash goes on in the next one.
std::string with_lines_joined(std::string text) {
  for (std::size_t at = text.find('\\'); at != std::string::npos; at = text.find('\\', at + 1)) {
    std::size_t end = at + 1;
    if (end < text.size() && text[end] == '\r') ++end;
    if (end < text.size() && text[end] == '\n') ++end;
    if (end > at + 1) std::fill_n(text.begin() + static_cast<std::ptrdiff_t>(at), end - at, ' ');
  }
  return text;
}

class ObjLines {
 public:
  ObjLines(const std::filesystem::path& path, std::string_view text) : path_(path), lines_(text) {}

  PlainMesh plain() {
    while (lines_.next()) {
      split_words(lines_.line().substr(0, lines_.line().find('#')), words_);
      if (words_.empty()) continue;
      if (words_[0] == "v") {
        copy_vertex();
      } else if (words_[0] == "f" || words_[0] == "fo") {  // "fo" is the old name
        copy_face();
      } else if (std::find(kDropped.begin(), kDropped.end(), words_[0]) == kDropped.end()) {
        refuse(words_[0], "a statement of an OBJ file");
      }
    }
    if (largest_ > static_cast<long long>(plain_.vertices)) {
      throw_bad_file(path_, fmt::format("vertex {} in line {}", largest_, line_of_largest_),
                     fmt::format("one of {} vertices", plain_.vertices));
    }
    return std::move(plain_);
  }

 private:
  void copy_vertex() {
    if (words_.size() < 4) refuse(lines_.line(), "v X Y Z");
    plain_.bytes += 'v';
    for (std::size_t i = 1; i < 4; ++i) {
      if (!finite_number(words_[i])) refuse(words_[i], "a finite number");
      plain_.bytes += ' ';
      plain_.bytes += words_[i];
    }
    plain_.bytes += '\n';
    ++plain_.vertices;
  }

  /// The vertex a corner ("7", "7/2", "7//3", "-1") names, counted from 1.
  long long vertex_of(std::string_view corner) {
    const auto index = whole_number(corner.substr(0, corner.find('/')));
    if (!index || *index == 0) refuse(corner, "the number of a vertex");
    const auto known = static_cast<long long>(plain_.vertices);
    if (*index < -known) refuse(corner, fmt::format("one of the {} vertices before it", known));
    if (*index > largest_) {  // it may come later
      largest_ = *index;
      line_of_largest_ = lines_.number();
    }
    return *index < 0 ? known + 1 + *index : *index;
  }

  void copy_face() {
    corners_.clear();
    for (std::size_t i = 1; i < words_.size(); ++i) corners_.push_back(vertex_of(words_[i]));
    if (corners_.size() < 3) refuse(lines_.line(), "at least three corners");
    std::vector<long long> distinct = corners_;
    std::sort(distinct.begin(), distinct.end());
    // OpenMesh leaves out faces with fewer than three corners of their own; they have no area.
    if (std::unique(distinct.begin(), distinct.end()) - distinct.begin() < 3) return;
    plain_.bytes += 'f';
    for (const long long corner : corners_) plain_.bytes += fmt::format(" {}", corner);
    plain_.bytes += '\n';
    ++plain_.faces;
  }

  [[noreturn]] void refuse(std::string_view found, const std::string& expected) const {
    throw_bad_file(path_, fmt::format("\"{}\" in line {}", printable(found), lines_.number()),
                   expected);
  }

  const std::filesystem::path& path_;
  TextLines lines_;
  std::vector<std::string_view> words_;
  std::vector<long long> corners_;
  long long largest_ = 0;
  std::size_t line_of_largest_ = 0;
  PlainMesh plain_;
};

}  // namespace

PlainMesh plain_obj(const std::filesystem::path& path, std::string bytes) {
  // What editors and old systems leave at the end of a text.
  while (!bytes.empty() && (bytes.back() == '\0' || bytes.back() == '\x1a')) bytes.pop_back();
  const std::string text = with_lines_joined(std::move(bytes));
  return ObjLines(path, text).plain();
}

}  // namespace nacre
