#include "datasets/random.h"

#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "datasets/portable_math.h"

namespace nacre {
namespace {

constexpr std::uint64_t kGoldenRatio = 0x9e3779b97f4a7c15;

/// In (0, 1), from 32 bits.
double open_uniform(std::uint32_t bits) { return (bits + 0.5) / 4294967296.0; }

/// The lattice's value at one of its points, in [-1, 1).
double lattice_value(std::uint64_t seed, std::int64_t x, std::int64_t y, std::int64_t z) {
  // 21 bits an axis: the lattice repeats after two million edges.
  constexpr std::uint64_t mask = (1u << 21) - 1;
  const std::uint64_t counter = (static_cast<std::uint64_t>(x) & mask) |
                                (static_cast<std::uint64_t>(y) & mask) << 21 |
                                (static_cast<std::uint64_t>(z) & mask) << 42;
  return static_cast<double>(random_bits(seed, counter) >> 11) * 0x1p-52 - 1.0;
}

double blend(double a, double b, double weight) { return a + weight * (b - a); }

}  // namespace

double RandomSequence::uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

std::uint64_t random_bits(std::uint64_t seed, std::uint64_t counter) {
  const auto scramble = [](std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  };
  // The seed is scrambled first, or seeds one apart would share all but one number.
  return scramble(scramble(seed + kGoldenRatio) + counter * kGoldenRatio);
}

glm::dvec2 normal_pair(std::uint64_t seed, std::uint64_t counter) {
  const std::uint64_t bits = random_bits(seed, counter);
  const double radius =
      std::sqrt(-2.0 * portable_log(open_uniform(static_cast<std::uint32_t>(bits >> 32))));
  const CosSin direction = portable_cos_sin(open_uniform(static_cast<std::uint32_t>(bits)));
  return {radius * direction.cosine, radius * direction.sine};
}

double smooth_noise(std::uint64_t seed, const glm::dvec3& p) {
  const glm::dvec3 base = glm::floor(p);
  const glm::dvec3 f = p - base;
  const glm::dvec3 weight = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  const auto x = static_cast<std::int64_t>(base.x);
  const auto y = static_cast<std::int64_t>(base.y);
  const auto z = static_cast<std::int64_t>(base.z);
  std::array<double, 4> along_x{};
  for (int edge = 0; edge < 4; ++edge) {
    const std::int64_t row = y + (edge & 1);
    const std::int64_t slice = z + (edge >> 1);
    along_x[static_cast<std::size_t>(edge)] =
        blend(lattice_value(seed, x, row, slice), lattice_value(seed, x + 1, row, slice), weight.x);
  }
  return blend(blend(along_x[0], along_x[1], weight.y), blend(along_x[2], along_x[3], weight.y),
               weight.z);
}

}  // namespace nacre
