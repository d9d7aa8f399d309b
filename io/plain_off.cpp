// OFF reduced to what OpenMesh reads (see plain_mesh.h).
#include <fmt/core.h>

#include <vector>

#include "io/bad_file.h"
#include "io/plain_mesh.h"
#include "io/text_lines.h"

namespace nacre {
namespace {

/// Whether a word is [ST][C][N]OFF: texture coordinates, colours and normals follow the positions.
bool is_keyword(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N"}) {
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  }
  return word == "OFF";
}

class OffLines {
 public:
  OffLines(const std::filesystem::path& path, std::string_view text) : path_(path), lines_(text) {}

  PlainMesh plain() {
    read_counts();
    plain_.bytes = fmt::format("OFF\n{} {} 0\n", plain_.vertices, plain_.faces);
    for (std::size_t i = 0; i < plain_.vertices; ++i) {
      next_line(fmt::format("{} of {} vertices", i, plain_.vertices));
      copy(3, false);
    }
    for (std::size_t i = 0; i < plain_.faces; ++i) {
      next_line(fmt::format("{} of {} faces", i, plain_.faces));
      const auto corners = whole_number(words_[0]);
      if (!corners || *corners < 0) refuse("a number of corners");
      copy(static_cast<std::size_t>(*corners) + 1, true);
    }
    return std::move(plain_);
  }

 private:
  /// The keyword, which may be absent, and the counts, which may stand beside it.
  void read_counts() {
    next_line("nothing");
    if (is_keyword(words_[0])) {
      words_.erase(words_.begin());
      if (!words_.empty() && words_[0] == "BINARY") {
        throw_bad_file(path_, "a binary OFF file", "a text one");
      }
      if (words_.empty()) next_line("no counts");
    }
    plain_.vertices = count(0);
    plain_.faces = count(1);
  }

  std::size_t count(std::size_t word) const {
    const auto number = word < words_.size() ? whole_number(words_[word]) : std::nullopt;
    if (!number || *number < 0) refuse("OFF and the numbers of vertices and faces");
    return static_cast<std::size_t>(*number);
  }

  /// Moves to the next line with words in it.
  void next_line(const std::string& found_so_far) {
    do {
      if (!lines_.next()) {
        throw_bad_file(path_, found_so_far + " (truncated)", "as many as its header says");
      }
      split_words(lines_.line().substr(0, lines_.line().find('#')), words_);
    } while (words_.empty());
  }

  /// Copies the first words of the line; colours and the like follow them.
  void copy(std::size_t count, bool whole) {
    if (words_.size() < count) refuse(fmt::format("{} numbers", count));
    for (std::size_t i = 0; i < count; ++i) {
      const bool good =
          whole ? whole_number(words_[i]).has_value() : finite_number(words_[i]).has_value();
      if (!good) refuse(whole ? "whole numbers" : "finite numbers");
      plain_.bytes += words_[i];
      plain_.bytes += i + 1 < count ? ' ' : '\n';
    }
  }

  [[noreturn]] void refuse(const std::string& expected) const {
    throw_bad_file(path_,
                   fmt::format("\"{}\" in line {}", printable(lines_.line()), lines_.number()),
                   expected);
  }

  const std::filesystem::path& path_;
  TextLines lines_;
  std::vector<std::string_view> words_;
  PlainMesh plain_;
};

}  // namespace

PlainMesh plain_off(const std::filesystem::path& path, std::string_view bytes) {
  return OffLines(path, bytes).plain();
}

}  // namespace nacre
