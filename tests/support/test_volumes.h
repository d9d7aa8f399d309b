#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

#include "core/camera.h"
#include "core/volume.h"
#include "core/volume_geometry.h"

namespace nacre::testing {

/// A volume of the samples `value(x, y, z)`, identity geometry.
template <class T, class Function>
Volume volume_of(const glm::i64vec3& dims, Function&& value) {
  Volume volume = make_volume(dims, scalar_type_of<T>());
  const auto samples = samples_as<T>(volume);
  std::size_t i = 0;
  for (std::int64_t z = 0; z < dims.z; ++z) {
    for (std::int64_t y = 0; y < dims.y; ++y) {
      for (std::int64_t x = 0; x < dims.x; ++x) samples[i++] = static_cast<T>(value(x, y, z));
    }
  }
  return volume;
}

/// Samples drawn evenly from [lo, hi], from a fixed seed.
template <class T>
Volume random_volume(const glm::i64vec3& dims, double lo, double hi, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  return volume_of<T>(dims, [&](auto, auto, auto) {
    const double s = unit(random);
    return lo * (1.0 - s) + hi * s;  // hi - lo may overflow
  });
}

/// A camera on a volume.
inline Camera camera_of(const Volume& volume, const CameraOptions& options) {
  return make_camera(options, bounding_sphere(volume.dims, volume.world_from_voxel));
}

}  // namespace nacre::testing
