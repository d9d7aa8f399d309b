#include "extract/sample_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace nacre {
namespace {

template <class T>
class SampleRange : public ::testing::Test {};

using StoredTypes = ::testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t,
                                     std::uint32_t, std::int32_t, float, double>;
TYPED_TEST_SUITE(SampleRange, StoredTypes);

/// The whole range of the type, its ends among them.
template <class T>
std::vector<T> random_samples(std::size_t count, std::mt19937& random) {
  using Limits = std::numeric_limits<T>;
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::vector<T> samples(count);
  for (T& sample : samples) {
    const double u = part(random);
    const auto lowest = static_cast<double>(Limits::lowest());
    sample = static_cast<T>((1.0 - u) * lowest + u * static_cast<double>(Limits::max()));
    if (u < 0.01) sample = Limits::lowest();
    if (u > 0.99) sample = Limits::max();
  }
  return samples;
}

TYPED_TEST(SampleRange, IsTheSmallestAndTheLargestAtAnyPlace) {
  std::mt19937 random(7);
  for (std::size_t count = 1; count <= 80; ++count) {
    for (int repeat = 0; repeat < 20; ++repeat) {
      const std::vector<TypeParam> samples = random_samples<TypeParam>(count, random);
      const auto [least, largest] = std::minmax_element(samples.begin(), samples.end());
      const auto found = sample_range(std::span<const TypeParam>(samples));
      ASSERT_EQ(found, std::pair(*least, *largest)) << count << " samples";
    }
  }
}

}  // namespace
}  // namespace nacre
