// The exact maximum of a one-voxel volume, through the installed library, and back from a file.
#include <core/volume.h>
#include <io/picture_file.h>
#include <io/volume_reader.h>
#include <io/volume_writer.h>
#include <reference/exact_walk.h>

#include <cstdint>
#include <cstdio>

int main() {
  nacre::Volume volume = nacre::make_volume({1, 1, 1}, nacre::ScalarType::U8);
  nacre::samples_as<std::uint8_t>(volume)[0] = 50;
  nacre::write_volume(volume, "one.nii");
  const nacre::Volume read = nacre::read_volume("one.nii").volume;
  const nacre::ExactWalk walk(read, nacre::EmissionMap::window(0.0, 100.0));
  const double most = walk.max_emission({{0.0, 0.0, -5.0}, {0.0, 0.0, 1.0}});
  std::printf("maximum emission %g\n", most);
  nacre::write_measured_picture(nacre::make_image(1, 1), nacre::PictureMode::Max, "one.tif");
  return most == 0.5 ? 0 : 1;
}
