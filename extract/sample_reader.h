#pragma once

#include <cstddef>

#include "core/volume.h"

namespace nacre {

/// The stored samples one at a time, whatever their type, for the few places that need a value
/// rather than a class.
class SampleReader {
 public:
  explicit SampleReader(const Volume& volume)
      : samples_(volume.samples.data()),
        read_(visit_scalar_type(volume.type, [](auto zero) { return &read<decltype(zero)>; })) {}

  double operator[](std::size_t index) const { return read_(samples_, index); }

 private:
  template <class T>
  static double read(const std::byte* samples, std::size_t index) {
    return static_cast<double>(reinterpret_cast<const T*>(samples)[index]);
  }

  const std::byte* samples_;
  double (*read_)(const std::byte*, std::size_t);
};

}  // namespace nacre
