#include "io/nifti_writer.h"

#include <nifti/nifti1.h>
#include <nifti/nifti2.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "core/volume_geometry.h"
#include "io/atomic_file.h"
#include "io/gzip_writer.h"

namespace nacre {
namespace {

int data_type(ScalarType type) {
  switch (type) {
    case ScalarType::U8: return DT_UINT8;
    case ScalarType::I8: return DT_INT8;
    case ScalarType::U16: return DT_UINT16;
    case ScalarType::I16: return DT_INT16;
    case ScalarType::U32: return DT_UINT32;
    case ScalarType::I32: return DT_INT32;
    case ScalarType::F32: return DT_FLOAT32;
    case ScalarType::F64: break;
  }
  return DT_FLOAT64;
}

/// The first three rows of ras_from_voxel.
using Rows = std::array<std::array<double, 4>, 3>;

Rows ras_rows(const glm::dmat4& lps_from_voxel) {
  Rows rows{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
          (row < 2 ? -1.0 : 1.0) * lps_from_voxel[column][row] + 0.0;
    }
  }
  return rows;
}

bool is_exact_in_float(double value) {
  return static_cast<double>(static_cast<float>(value)) == value;
}

/// True if the 16-bit sizes and 32-bit numbers of NIfTI-1 say the same as the volume.
bool fits_version_1(const Volume& volume, const Rows& rows) {
  bool fits = is_exact_in_float(volume.slope) && is_exact_in_float(volume.intercept);
  for (const auto& row : rows) fits &= std::all_of(row.begin(), row.end(), is_exact_in_float);
  for (int axis = 0; axis < 3; ++axis) {
    fits &= volume.dims[axis] <= std::numeric_limits<std::int16_t>::max();
  }
  return fits;
}

template <class Header>
Header make_header(const Volume& volume, const Rows& rows) {
  Header header;
  std::memset(&header, 0, sizeof(header));
  header.sizeof_hdr = sizeof(Header);
  std::fill(std::begin(header.dim), std::end(header.dim),
            static_cast<std::remove_reference_t<decltype(header.dim[0])>>(1));
  header.dim[0] = 3;
  header.pixdim[0] = 1;
  using Real = std::remove_reference_t<decltype(header.pixdim[0])>;
  const glm::dvec3 spacing = spacing_mm(volume.world_from_voxel);
  for (int axis = 0; axis < 3; ++axis) {
    header.dim[axis + 1] =
        static_cast<std::remove_reference_t<decltype(header.dim[0])>>(volume.dims[axis]);
    header.pixdim[axis + 1] = static_cast<Real>(spacing[axis]);
  }
  header.datatype = static_cast<std::int16_t>(data_type(volume.type));
  header.bitpix = static_cast<std::int16_t>(8 * size_of(volume.type));
  header.vox_offset = sizeof(Header) + 4;  // four bytes say that no extensions follow
  header.scl_slope = static_cast<Real>(volume.slope);
  header.scl_inter = static_cast<Real>(volume.intercept);
  header.xyzt_units = NIFTI_UNITS_MM;
  header.sform_code = NIFTI_XFORM_SCANNER_ANAT;
  for (std::size_t column = 0; column < 4; ++column) {
    header.srow_x[column] = static_cast<Real>(rows[0][column]);
    header.srow_y[column] = static_cast<Real>(rows[1][column]);
    header.srow_z[column] = static_cast<Real>(rows[2][column]);
  }
  return header;
}

/// The header's bytes and the four after it.
template <class Header>
std::vector<std::byte> header_bytes(Header header, std::span<const char> magic) {
  std::memcpy(header.magic, magic.data(), magic.size());
  std::vector<std::byte> bytes(sizeof(Header) + 4);
  std::memcpy(bytes.data(), &header, sizeof(Header));
  return bytes;
}

std::vector<std::byte> nifti_header(const Volume& volume) {
  const Rows rows = ras_rows(volume.world_from_voxel);
  if (fits_version_1(volume, rows)) {
    constexpr std::array<char, 4> magic{'n', '+', '1', '\0'};
    return header_bytes(make_header<nifti_1_header>(volume, rows), magic);
  }
  constexpr std::array<char, 8> magic{'n', '+', '2', '\0', '\r', '\n', '\032', '\n'};
  return header_bytes(make_header<nifti_2_header>(volume, rows), magic);
}

}  // namespace

void write_nifti(const Volume& volume, const std::filesystem::path& path) {
  const std::vector<std::byte> header = nifti_header(volume);
  const std::span<const std::byte> samples(volume.samples.data(), volume.samples.size());
  AtomicFile file(path);
  if (path.extension() == ".gz" || path.extension() == ".GZ") {
    GzipWriter gzip(file);
    gzip.write(header);
    gzip.write(samples);
    gzip.finish();
  } else {
    file.write(header);
    file.write(samples);
  }
  file.commit();
}

}  // namespace nacre
