#include "io/metaimage_volume.h"

#include <fmt/core.h>
#include <itkMetaImageIO.h>

#include <iostream>
#include <sstream>
#include <string>

#include "io/bad_file.h"
#include "io/metaimage_text.h"
#include "io/stored_samples.h"
#include "io/volume_checks.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

/// Catches what the library prints: errors are ours to report.
class SilentStreams {
 public:
  SilentStreams() : out_(std::cout.rdbuf(sink_.rdbuf())), err_(std::cerr.rdbuf(sink_.rdbuf())) {}
  ~SilentStreams() {
    std::cout.rdbuf(out_);
    std::cerr.rdbuf(err_);
  }
  SilentStreams(const SilentStreams&) = delete;
  SilentStreams& operator=(const SilentStreams&) = delete;

 private:
  std::ostringstream sink_;
  std::streambuf* out_;
  std::streambuf* err_;
};

itk::MetaImageIO::Pointer parse(const fs::path& path) {
  const SilentStreams silent;
  auto header = itk::MetaImageIO::New();
  try {
    header->SetFileName(path.string());
    header->ReadImageInformation();
  } catch (const itk::ExceptionObject&) {
    throw_bad_file(path, "a damaged header", "NDims, DimSize, ElementType and ElementDataFile");
  }
  return header;
}

StoredType stored_type(const fs::path& path, MET_ValueEnumType type) {
  switch (type) {
    case MET_CHAR:
    case MET_ASCII_CHAR: return StoredType::I8;
    case MET_UCHAR: return StoredType::U8;
    case MET_SHORT: return StoredType::I16;
    case MET_USHORT: return StoredType::U16;
    case MET_INT:
    case MET_LONG: return StoredType::I32;
    case MET_UINT:
    case MET_ULONG: return StoredType::U32;
    case MET_LONG_LONG: return StoredType::I64;
    case MET_ULONG_LONG: return StoredType::U64;
    case MET_FLOAT: return StoredType::F32;
    case MET_DOUBLE: return StoredType::F64;
    default: break;
  }
  throw_bad_file(path, fmt::format("samples of type {}", MET_ValueTypeName[type]),
                 "integers or real numbers");
}

glm::i64vec3 dimensions(const fs::path& path, const MetaImage& image) {
  glm::i64vec3 dims(1);
  std::string sizes;
  bool more_than_three = false;
  for (int axis = 0; axis < image.NDims(); ++axis) {
    const int size = image.DimSize(axis);
    sizes += (axis > 0 ? " x " : "") + std::to_string(size);
    if (axis < 3) dims[axis] = size;
    if (axis >= 3) more_than_three |= size != 1;
  }
  if (more_than_three || image.NDims() < 2) {
    throw_bad_file(path, fmt::format("{} dimensions ({})", image.NDims(), sizes),
                   "one volume of 3 dimensions, or a slice of 2");
  }
  if (image.ElementNumberOfChannels() != 1) {
    throw_bad_file(
        path,
        fmt::format("{} channels (colour, complex or vector)", image.ElementNumberOfChannels()),
        "1");
  }
  return dims;
}

double mm_per_unit(MET_DistanceUnitsEnumType units) {
  switch (units) {
    case MET_DISTANCE_UNITS_UM: return 1e-3;
    case MET_DISTANCE_UNITS_CM: return 10.0;
    default: return 1.0;
  }
}

/// Row i of TransformMatrix is the direction of axis i.
glm::dmat4 lps_mm_from_voxel(const fs::path& path, const MetaImage& image) {
  const int n = image.NDims();
  const double unit = mm_per_unit(image.DistanceUnits());
  glm::dmat4 matrix(1.0);
  for (int axis = 0; axis < std::min(n, 3); ++axis) {
    const double spacing = image.ElementSpacing(axis);
    if (!(spacing > 0.0)) {
      throw_bad_file(path, fmt::format("a spacing of {} along axis {}", spacing, axis),
                     "a positive one");
    }
    for (int row = 0; row < std::min(n, 3); ++row) {
      matrix[axis][row] = unit * (spacing * image.TransformMatrix()[axis * n + row]) + 0.0;
    }
    matrix[3][axis] = unit * image.Offset(axis) + 0.0;
  }
  return matrix;
}

StoredSamples where_samples_lie(const MetaImage& image, const MetaImageText& text) {
  StoredSamples stored;
  stored.big_endian = image.BinaryDataByteOrderMSB();
  stored.at_file_end = image.HeaderSize() == -1;
  for (const fs::path& file : text.data_files) {
    Stretch stretch{.path = file, .offset = text.end};
    // Counted from the start of the file, where the header itself may be.
    if (image.HeaderSize() > 0) stretch.offset = static_cast<std::uint64_t>(image.HeaderSize());
    if (image.CompressedData()) stretch.packing = Packing::Deflated;
    stored.pieces.push_back(stretch);
  }
  return stored;
}

}  // namespace

Volume read_metaimage(const fs::path& path, VolumeReadReport& report) {
  report.format = "MetaImage";
  const MetaImageText text = read_metaimage_text(path);
  const itk::MetaImageIO::Pointer header = parse(path);
  const MetaImage& image = *header->GetMetaImagePointer();

  if (!image.BinaryData()) throw_bad_file(path, "samples as text", "binary ones");
  StoredSamples stored = where_samples_lie(image, text);
  stored.type = stored_type(path, image.ElementType());
  stored.dims = dimensions(path, image);
  const glm::dmat4 world_from_voxel = lps_mm_from_voxel(path, image);
  check_geometry(path, world_from_voxel, report);
  Volume volume = read_stored_samples(path, stored, report);
  volume.world_from_voxel = world_from_voxel;
  set_scaling(path, image.ElementToIntensityFunctionSlope(),
              image.ElementToIntensityFunctionOffset(), volume);
  return volume;
}

}  // namespace nacre
