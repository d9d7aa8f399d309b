#include "io/pose_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <string>
#include <vector>

#include "io/bad_file.h"
#include "io/byte_source.h"
#include "io/text_lines.h"

namespace nacre {
namespace {

constexpr std::uint64_t kMostBytes = 1 << 20;
constexpr double kTolerance = 1e-4;  // of a rotation: poses are written with few digits

std::string text_of(const std::filesystem::path& path) {
  const FileSource source(path);
  if (source.size() > kMostBytes) {
    throw_bad_file(path, fmt::format("{} bytes", source.size()), "a pose: 16 numbers");
  }
  const std::vector<std::byte> bytes = source.read(0, static_cast<std::size_t>(source.size()));
  std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::replace(text.begin(), text.end(), ',', ' ');
  return text;
}

std::vector<double> numbers_of(const std::filesystem::path& path, const std::string& text) {
  std::vector<double> numbers;
  std::vector<std::string_view> words;
  TextLines lines(text);
  while (lines.next()) {
    split_words(lines.line().substr(0, lines.line().find('#')), words);
    for (const std::string_view word : words) {
      const auto number = finite_number(word);
      if (!number) {
        throw_bad_file(path, fmt::format("\"{}\" in line {}", printable(word), lines.number()),
                       "a pose: 16 numbers");
      }
      numbers.push_back(*number);
    }
  }
  return numbers;
}

void check_rigid(const std::filesystem::path& path, const glm::dmat4& pose) {
  const glm::dvec4 last_row(pose[0][3], pose[1][3], pose[2][3], pose[3][3]);
  if (last_row != glm::dvec4(0.0, 0.0, 0.0, 1.0)) {
    throw_bad_file(
        path,
        fmt::format("the last row {} {} {} {}", last_row[0], last_row[1], last_row[2], last_row[3]),
        "0 0 0 1 (are the rows columns?)");
  }
  const glm::dmat3 rotation(pose);
  const double determinant = glm::determinant(rotation);
  const glm::dmat3 product = glm::transpose(rotation) * rotation;
  double departure = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      departure = std::max(departure, std::abs(product[i][j] - (i == j ? 1.0 : 0.0)));
    }
  }
  if (!(departure <= kTolerance) || determinant < 0.0) {
    throw_bad_file(path,
                   fmt::format("a matrix of determinant {:.6g} that is {:.3g} off a rotation",
                               determinant, departure),
                   "a rigid pose (a size belongs in scale=, a mirror image nowhere)");
  }
}

}  // namespace

glm::dmat4 read_pose(const std::filesystem::path& path) {
  const std::vector<double> numbers = numbers_of(path, text_of(path));
  if (numbers.size() != 16) {
    throw_bad_file(path, fmt::format("{} numbers", numbers.size()),
                   "a pose: 16 numbers, row by row");
  }
  glm::dmat4 pose(1.0);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      pose[column][row] =
          numbers[4 * static_cast<std::size_t>(row) + static_cast<std::size_t>(column)];
    }
  }
  check_rigid(path, pose);
  return pose;
}

}  // namespace nacre
