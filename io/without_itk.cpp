// The readers that need ITK or GDCM, in a build without them.
#include <fmt/core.h>

#include "core/error.h"
#include "io/dicom_series.h"
#include "io/metaimage_volume.h"
#include "io/nrrd_volume.h"

namespace nacre {
namespace {

[[noreturn]] void throw_not_built_in(const std::filesystem::path& path, std::string_view format) {
  throw Error(ErrorCode::Unsupported,
              fmt::format("{}: found {}, expected another format: built without ITK and GDCM",
                          path.string(), format));
}

}  // namespace

Volume read_nrrd(const std::filesystem::path& path, VolumeReadReport& /*report*/) {
  throw_not_built_in(path, "an NRRD volume");
}

Volume read_metaimage(const std::filesystem::path& path, VolumeReadReport& /*report*/) {
  throw_not_built_in(path, "a MetaImage volume");
}

Volume read_dicom_series(const std::filesystem::path& folder, const std::string& /*series_uid*/,
                         VolumeReadReport& /*report*/) {
  throw_not_built_in(folder, "a folder, perhaps a DICOM series");
}

}  // namespace nacre
