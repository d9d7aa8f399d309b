#include "io/volume_reader.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <system_error>

#include "core/error.h"
#include "io/bad_file.h"
#include "io/dicom_magic.h"
#include "io/dicom_series.h"
#include "io/metaimage_volume.h"
#include "io/nifti_volume.h"
#include "io/non_finite.h"
#include "io/nrrd_volume.h"
#include "io/stretch.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

bool ends_with_any(const std::string& name, std::initializer_list<const char*> endings) {
  return std::any_of(endings.begin(), endings.end(),
                     [&](const char* ending) { return name.ends_with(ending); });
}

Volume read_by_kind(const fs::path& path, const VolumeReadOptions& options,
                    VolumeReadReport& report) {
  if (options.raw) return read_raw(path, *options.raw, report);
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    return read_dicom_series(path, options.dicom_series, report);
  }
  file_size_of(path);  // says that nothing is there before any reader says what it is not
  std::string name = path.filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ends_with_any(name, {".nii", ".nii.gz", ".hdr", ".hdr.gz", ".img", ".img.gz"})) {
    return read_nifti(path, report);
  }
  if (ends_with_any(name, {".nrrd", ".nhdr"})) return read_nrrd(path, report);
  if (ends_with_any(name, {".mha", ".mhd"})) return read_metaimage(path, report);
  if (name.ends_with(".dcm") || has_dicom_magic(path)) {
    throw_bad_file(path, "one DICOM file", "the folder that holds its series");
  }
  throw_bad_file(path, fmt::format("extension \"{}\"", printable(path.extension().string())),
                 ".nii, .nii.gz, .hdr, .img, .nrrd, .nhdr, .mha, .mhd, a DICOM folder, or --raw");
}

}  // namespace

VolumeFile read_volume(const fs::path& path, const VolumeReadOptions& options) {
  VolumeFile file;
  file.volume = read_by_kind(path, options, file.report);
  replace_non_finite(path, file.volume, file.report);
  if (options.crop) file.volume = crop_volume(path, file.volume, *options.crop);
  return file;
}

}  // namespace nacre
