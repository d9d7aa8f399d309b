#include "extract/lattice_slice.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace nacre {
namespace {

constexpr unsigned kSeed = 1;

TEST(LatticeSlice, ForEachDifferenceNamesEachOnceInOrder) {
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<int> byte(0, 255);
  std::bernoulli_distribution differs(0.2);
  for (std::size_t end = 0; end <= 200; ++end) {
    std::vector<std::uint8_t> a(end + kRowPadding);
    std::vector<std::uint8_t> b(end + kRowPadding);
    std::vector<std::size_t> expected;
    const std::size_t begin = end / 3;
    for (std::size_t i = 0; i < a.size(); ++i) {
      a[i] = static_cast<std::uint8_t>(byte(random));
      b[i] = differs(random) ? static_cast<std::uint8_t>(byte(random)) : a[i];
      if (i >= begin && i < end && a[i] != b[i]) expected.push_back(i);
    }
    std::vector<std::size_t> found;
    for_each_difference(a.data(), b.data(), begin, end,
                        [&found](std::size_t i) { found.push_back(i); });
    EXPECT_EQ(found, expected) << "end = " << end;
  }
}

}  // namespace
}  // namespace nacre
