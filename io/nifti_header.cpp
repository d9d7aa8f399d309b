#include "io/nifti_header.h"

#include <fmt/core.h>
#include <nifti/nifti2_io.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <span>

#include "io/bad_file.h"
#include "io/stretch.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

struct FreeImage {
  void operator()(nifti_image* image) const noexcept { nifti_image_free(image); }
};
using NiftiImage = std::unique_ptr<nifti_image, FreeImage>;

/// The bytes of the larger of the two headers, zeros where the file is shorter.
struct HeaderBytes {
  alignas(8) std::array<std::byte, sizeof(nifti_2_header)> bytes{};
  std::size_t size = 0;
};

HeaderBytes read_header_bytes(const fs::path& path) {
  HeaderBytes header;
  StretchReader reader(Stretch{.path = path, .packing = packing_of(path)});
  header.size = reader.read_some(header.bytes);
  if (header.size == 0) throw_bad_file(path, "an empty file", "a NIfTI header of 348 or 540 bytes");
  return header;
}

/// Refuses what the library would mend in silence: it sets bad sizes to 1, cuts numbers that are
/// not finite to 0, and takes dim[0] for a sign of swapped bytes.
template <class Header>
NiftiHeader checked_fields(const fs::path& path, const Header& raw) {
  NiftiHeader header;
  header.dim.fill(1);
  const auto dimensions = static_cast<std::int64_t>(raw.dim[0]);
  if (dimensions < 1 || dimensions > 7) {
    throw_bad_file(path, fmt::format("{} dimensions", dimensions), "1 to 7");
  }
  header.dim[0] = dimensions;
  for (std::size_t axis = 1; axis <= static_cast<std::size_t>(dimensions); ++axis) {
    header.dim[axis] = raw.dim[axis];
    if (raw.dim[axis] < 1) {
      throw_bad_file(path, fmt::format("{} samples along dimension {}", header.dim[axis], axis),
                     "at least 1");
    }
  }
  for (std::size_t axis = 0; axis < 8; ++axis) {
    header.pixdim[axis] = static_cast<double>(raw.pixdim[axis]);
  }
  const auto offset = static_cast<double>(raw.vox_offset);
  if (!(offset >= 0.0 && offset < 0x1p53)) {
    throw_bad_file(path, fmt::format("samples at byte {}", offset), "an offset within the file");
  }
  header.offset = static_cast<std::uint64_t>(offset);
  for (const auto number :
       {raw.quatern_b, raw.quatern_c, raw.quatern_d, raw.qoffset_x, raw.qoffset_y, raw.qoffset_z}) {
    if (raw.qform_code > 0 && !std::isfinite(number)) {
      throw_bad_file(path, "a qform that is not finite", "finite numbers");
    }
  }
  header.slope = static_cast<double>(raw.scl_slope);
  header.intercept = static_cast<double>(raw.scl_inter);
  header.datatype = raw.datatype;
  return header;
}

template <class Header>
Header as_header(const HeaderBytes& bytes) {
  Header header;
  std::memcpy(&header, bytes.bytes.data(), sizeof(header));
  return header;
}

glm::dmat4 as_matrix(const nifti_dmat44& rows) {
  glm::dmat4 matrix;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) matrix[column][row] = rows.m[row][column];
  }
  return matrix;
}

double mm_per_unit(int xyz_units) {
  switch (xyz_units) {
    case NIFTI_UNITS_METER: return 1000.0;
    case NIFTI_UNITS_MICRON: return 0.001;
    default: return 1.0;  // millimetres, or unknown
  }
}

/// The fields of a NIfTI-1 or NIfTI-2 header, and the forms as the library works them out.
template <class Header>
NiftiHeader interpret(const fs::path& path, const HeaderBytes& bytes, int version,
                      nifti_image* (*to_image)(Header, const char*)) {
  const auto raw = as_header<Header>(bytes);
  Header native = raw;
  const bool swapped = raw.sizeof_hdr != static_cast<int>(sizeof(Header));
  if (swapped) swap_nifti_header(&native, version);

  NiftiHeader header = checked_fields(path, native);
  header.version = version;
  header.single_file = native.magic[1] == '+';
  header.big_endian = swapped == (std::endian::native == std::endian::little);
  if (header.datatype == DT_BINARY || nifti_is_valid_datatype(header.datatype) == 0) {
    throw_bad_file(path,
                   fmt::format("samples of type {} (code {})", nifti_type_name(header.datatype),
                               header.datatype),
                   "integers or real numbers");
  }
  const NiftiImage image(to_image(raw, path.c_str()));
  if (image == nullptr) throw_bad_file(path, "a damaged header", "a NIfTI header");
  header.mm_per_unit = mm_per_unit(image->xyz_units);
  if (image->sform_code > 0) header.sform = as_matrix(image->sto_xyz);
  if (image->qform_code > 0) header.qform = as_matrix(image->qto_xyz);
  // The samples of a single file start after the header, whatever the offset says.
  if (header.single_file) header.offset = std::max<std::uint64_t>(header.offset, sizeof(Header));
  return header;
}

}  // namespace

NiftiHeader read_nifti_header(const fs::path& path) {
  nifti_set_debug_level(0);
  const HeaderBytes bytes = read_header_bytes(path);
  const int version =
      bytes.size < sizeof(nifti_1_header)
          ? -1
          : nifti_header_version(reinterpret_cast<const char*>(bytes.bytes.data()), bytes.size);
  if (version == 0) {
    throw_bad_file(path, "an ANALYZE 7.5 header, which says no orientation", "NIfTI-1 or NIfTI-2");
  }
  if (version == 1) return interpret<nifti_1_header>(path, bytes, 1, nifti_convert_n1hdr2nim);
  if (version == 2 && bytes.size == sizeof(nifti_2_header)) {
    return interpret<nifti_2_header>(path, bytes, 2, nifti_convert_n2hdr2nim);
  }
  throw_bad_file(path, fmt::format("{} bytes that are no NIfTI header", bytes.size),
                 "a NIfTI-1 header of 348 or a NIfTI-2 header of 540");
}

const char* nifti_type_name(int datatype) { return nifti_datatype_to_string(datatype); }

}  // namespace nacre
