#pragma once

#include <cstdint>
#include <vector>

#include "core/volume.h"

namespace nacre {

/// Order statistics of a volume's values, exact for every stored type.
///
/// A radix selection on the samples' bits: one parallel pass counts the upper 16 bits of each
/// sample (of an order-preserving code), further passes the next 16 of the samples in question: one
/// pass for 8 and 16-bit volumes, two for 32-bit ones, four for f64. No sorted copy is made.
class SampleRanks {
 public:
  /// One pass over the volume, which must outlive this object.
  explicit SampleRanks(const Volume& volume);

  std::uint64_t count() const noexcept { return count_; }

  /// The value (slope and intercept applied) at a rank in ascending order.
  /// @param rank  0 (the least value) to count() - 1
  double value_at(std::uint64_t rank) const;

  /// How many samples have the least value.
  std::uint64_t count_of_least() const;

 private:
  /// The stored sample that has the value of that rank.
  double stored_at(std::uint64_t rank) const;

  const Volume& volume_;
  std::uint64_t count_;
  std::vector<std::uint64_t> upper_counts_;  ///< samples by the upper 16 bits of their code
};

}  // namespace nacre
