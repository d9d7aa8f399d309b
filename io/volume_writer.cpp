#include "io/volume_writer.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <string>

#include "core/error.h"
#include "io/metaimage_writer.h"
#include "io/nifti_writer.h"
#include "io/nrrd_writer.h"

namespace nacre {

namespace {

using WriteFunction = void (*)(const Volume&, const std::filesystem::path&);

WriteFunction writer_for(const std::filesystem::path& path) {
  std::string name = path.filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (name.ends_with(".nii") || name.ends_with(".nii.gz")) return write_nifti;
  if (name.ends_with(".nrrd") || name.ends_with(".nhdr")) return write_nrrd;
  if (name.ends_with(".mha") || name.ends_with(".mhd")) return write_metaimage;
  throw Error(ErrorCode::BadArgument,
              fmt::format("{}: found extension \"{}\", expected .nrrd, .nhdr, .mha, .mhd, .nii or "
                          ".nii.gz",
                          path.string(), path.extension().string()));
}

}  // namespace

void require_volume_name(const std::filesystem::path& path) { writer_for(path); }

void write_volume(const Volume& volume, const std::filesystem::path& path) {
  writer_for(path)(volume, path);
}

}  // namespace nacre
