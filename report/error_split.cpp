#include "report/error_split.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace nacre {
namespace {

/// Sums over the pixels of one cause's differences.
struct Sums {
  double squares = 0.0;
  double squares_lit = 0.0;
  double sum = 0.0;
  double with_total = 0.0;  ///< of d times D
  double largest = 0.0;

  void add(double difference, double total, bool lit) {
    squares += difference * difference;
    if (lit) squares_lit += difference * difference;
    sum += difference;
    with_total += difference * total;
    largest = std::max(largest, std::abs(difference));
  }
};

ErrorPart part_of(const std::string& cause, const Sums& sums, double total_squares,
                  std::size_t pixels, std::size_t lit) {
  const auto mean = [](double sum, std::size_t count) {
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
  };
  ErrorPart part;
  part.cause = cause;
  part.rmse = std::sqrt(mean(sums.squares, pixels));
  part.rmse_lit = std::sqrt(mean(sums.squares_lit, lit));
  part.max_error = sums.largest;
  part.bias = mean(sums.sum, pixels);
  part.share = total_squares > 0.0 ? sums.with_total / total_squares : 0.0;
  return part;
}

void check(const Image& truth, std::span<const ErrorStage> stages) {
  if (stages.empty()) {
    throw Error(ErrorCode::BadArgument, "error split: found no picture, expected one or more");
  }
  for (const ErrorStage& stage : stages) {
    if (stage.picture.width == truth.width && stage.picture.height == truth.height) continue;
    throw Error(ErrorCode::BadArgument,
                fmt::format("error split: found a picture of {} x {} pixels ({}), expected {} x {}",
                            stage.picture.width, stage.picture.height, stage.cause, truth.width,
                            truth.height));
  }
}

}  // namespace

ErrorSplit split_error(const Image& truth, std::span<const ErrorStage> stages) {
  check(truth, stages);
  const Image& last = stages.back().picture;
  std::vector<Sums> sums(stages.size());
  Sums total;
  std::size_t lit_pixels = 0;
  for (std::size_t pixel = 0; pixel < truth.pixels.size(); ++pixel) {
    const auto value = [pixel](const Image& image) -> double { return image.pixels[pixel]; };
    const double error = value(last) - value(truth);
    const bool lit = value(truth) > 0.0;
    lit_pixels += lit ? 1 : 0;
    total.add(error, error, lit);
    double before = value(truth);
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const double here = value(stages[i].picture);
      sums[i].add(here - before, error, lit);
      before = here;
    }
  }
  ErrorSplit split;
  const std::size_t pixels = truth.pixels.size();
  split.total = part_of("total", total, total.squares, pixels, lit_pixels);
  for (std::size_t i = 0; i < stages.size(); ++i) {
    split.parts.push_back(part_of(stages[i].cause, sums[i], total.squares, pixels, lit_pixels));
    if (split.parts[i].share > split.parts[split.dominant].share) split.dominant = i;
  }
  return split;
}

}  // namespace nacre
