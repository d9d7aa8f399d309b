#include "io/dicom_magic.h"

#include <array>
#include <fstream>
#include <string_view>

namespace nacre {

bool has_dicom_magic(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 4> magic{};
  file.seekg(128);
  return file.read(magic.data(), magic.size()) && std::string_view(magic.data(), 4) == "DICM";
}

}  // namespace nacre
