// The exact maximum of a one-voxel volume, through the installed library.
#include <core/volume.h>
#include <reference/exact_walk.h>

#include <cstdint>
#include <cstdio>

int main() {
  nacre::Volume volume = nacre::make_volume({1, 1, 1}, nacre::ScalarType::U8);
  nacre::samples_as<std::uint8_t>(volume)[0] = 50;
  const nacre::ExactWalk walk(volume, nacre::EmissionMap::window(0.0, 100.0));
  const double most = walk.max_emission({{0.0, 0.0, -5.0}, {0.0, 0.0, 1.0}});
  std::printf("maximum emission %g\n", most);
  return most == 0.5 ? 0 : 1;
}
