#include "io/nifti_volume.h"

#include <fmt/core.h>
#include <nifti/nifti1.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <system_error>

#include "core/volume_geometry.h"
#include "io/bad_file.h"
#include "io/nifti_header.h"
#include "io/stored_samples.h"
#include "io/volume_checks.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

std::optional<StoredType> stored_type(int datatype) {
  switch (datatype) {
    case DT_UINT8: return StoredType::U8;
    case DT_INT8: return StoredType::I8;
    case DT_UINT16: return StoredType::U16;
    case DT_INT16: return StoredType::I16;
    case DT_UINT32: return StoredType::U32;
    case DT_INT32: return StoredType::I32;
    case DT_FLOAT32: return StoredType::F32;
    case DT_FLOAT64: return StoredType::F64;
    case DT_INT64: return StoredType::I64;
    case DT_UINT64: return StoredType::U64;
    default: return std::nullopt;
  }
}

/// "colour" and "complex" for the types that are; else what the type is called.
std::string refused_kind(int datatype) {
  const std::string type = nifti_type_name(datatype);
  if (datatype == DT_RGB24 || datatype == DT_RGBA32) return "colour samples (" + type + ")";
  if (datatype == DT_COMPLEX64 || datatype == DT_COMPLEX128 || datatype == DT_COMPLEX256) {
    return "complex samples (" + type + ")";
  }
  return "samples of type " + type;
}

glm::i64vec3 three_dimensions(const fs::path& path, const NiftiHeader& header) {
  for (std::size_t axis = 4; axis < 8; ++axis) {
    if (header.dim[axis] == 1) continue;
    std::string sizes = std::to_string(header.dim[1]);
    for (std::size_t i = 2; i <= static_cast<std::size_t>(header.dim[0]); ++i) {
      sizes += " x " + std::to_string(header.dim[i]);
    }
    throw_bad_file(path, fmt::format("{} dimensions ({})", header.dim[0], sizes),
                   "one volume of 3 dimensions");
  }
  return {header.dim[1], header.dim[2], header.dim[3]};
}

/// .hdr and .img lie side by side, and either may be gzipped.
fs::path image_path(const fs::path& header_path) {
  fs::path base = header_path;
  if (base.extension() == ".gz") base.replace_extension();
  for (const char* extension : {".img", ".img.gz", ".IMG"}) {
    fs::path candidate = base;
    candidate.replace_extension(extension);
    std::error_code ignored;
    if (fs::is_regular_file(candidate, ignored)) return candidate;
  }
  throw_bad_file(header_path, "no .img file beside it", "the samples there");
}

/// The name of an .img stands for its .hdr.
fs::path header_path_of(const fs::path& path) {
  fs::path base = path;
  if (base.extension() == ".gz") base.replace_extension();
  if (base.extension() != ".img" && base.extension() != ".IMG") return path;
  for (const char* extension : {".hdr", ".hdr.gz", ".HDR"}) {
    fs::path candidate = base;
    candidate.replace_extension(extension);
    std::error_code ignored;
    if (fs::is_regular_file(candidate, ignored)) return candidate;
  }
  throw_bad_file(path, "no .hdr file beside it", "a NIfTI header there");
}

/// The pixel sizes matter unless there is an sform; those of an axis of one sample may be missing.
void check_pixel_sizes(const fs::path& path, NiftiHeader& header, VolumeReadReport& report) {
  for (std::size_t axis = 1; axis <= 3; ++axis) {
    double& size = header.pixdim[axis];
    if (size == 0.0 && header.dim[axis] == 1) {
      size = 1.0;
      report.warnings.push_back(
          fmt::format("one sample and no spacing along axis {}: taken as 1", axis - 1));
    }
    if (!(size > 0.0) || !std::isfinite(size)) {
      throw_bad_file(path, fmt::format("a spacing of {} along axis {}", size, axis - 1),
                     "a positive one");
    }
  }
}

/// Largest distance between the two forms, over the corners of the volume.
double disagreement(const NiftiHeader& header) {
  double worst = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    glm::dvec4 p_voxel(0.0, 0.0, 0.0, 1.0);
    for (int axis = 0; axis < 3; ++axis) {
      const auto last = static_cast<double>(header.dim[static_cast<std::size_t>(axis) + 1] - 1);
      if (((corner >> axis) & 1) != 0) p_voxel[axis] = last;
    }
    worst = std::max(worst, glm::length(glm::dvec3((*header.sform - *header.qform) * p_voxel)));
  }
  return worst;
}

glm::dmat4 ras_from_voxel(const fs::path& path, NiftiHeader& header, VolumeReadReport& report) {
  if (header.sform) {
    if (header.qform) {
      const glm::dvec3 spacing = spacing_mm(*header.sform);
      const double apart = disagreement(header);
      if (!(apart <= std::min({spacing.x, spacing.y, spacing.z}))) {
        report.warnings.push_back(
            fmt::format("sform and qform disagree by up to {:.3g} mm; the sform is taken",
                        apart * header.mm_per_unit));
      }
    }
    return *header.sform;
  }
  check_pixel_sizes(path, header, report);
  if (header.qform) return *header.qform;
  report.warnings.emplace_back("the file states no orientation: axes assumed to run R, A, S");
  glm::dmat4 matrix(1.0);
  for (int axis = 0; axis < 3; ++axis) {
    matrix[axis][axis] = header.pixdim[static_cast<std::size_t>(axis) + 1];
  }
  return matrix;
}

glm::dmat4 lps_mm_from_ras(glm::dmat4 ras_from_voxel, double mm_per_unit) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      ras_from_voxel[column][row] *= row < 2 ? -mm_per_unit : mm_per_unit;
      // No negative zeros: they print badly and compare equal anyway.
      ras_from_voxel[column][row] += 0.0;
    }
  }
  return ras_from_voxel;
}

/// A slope of 0 or NaN is the format's way to say that there is none.
void set_nifti_scaling(const fs::path& path, const NiftiHeader& header, Volume& volume) {
  if (header.slope == 0.0 || std::isnan(header.slope)) return;
  set_scaling(path, header.slope, header.intercept, volume);
}

}  // namespace

Volume read_nifti(const fs::path& path, VolumeReadReport& report) {
  const fs::path header_path = header_path_of(path);
  file_size_of(header_path);
  NiftiHeader header = read_nifti_header(header_path);
  report.format = fmt::format("NIfTI-{}", header.version);

  const std::optional<StoredType> type = stored_type(header.datatype);
  if (!type) throw_bad_file(path, refused_kind(header.datatype), "integers or real numbers");
  const glm::i64vec3 dims = three_dimensions(path, header);
  const glm::dmat4 world_from_voxel =
      lps_mm_from_ras(ras_from_voxel(path, header, report), header.mm_per_unit);
  check_geometry(path, world_from_voxel, report);

  Stretch stretch{.path = header.single_file ? header_path : image_path(header_path)};
  stretch.packing = packing_of(stretch.path);
  (stretch.packing == Packing::Raw ? stretch.offset : stretch.skip) = header.offset;
  Volume volume = read_stored_samples(path, {dims, *type, header.big_endian, {stretch}}, report);
  volume.world_from_voxel = world_from_voxel;
  set_nifti_scaling(path, header, volume);
  return volume;
}

}  // namespace nacre
