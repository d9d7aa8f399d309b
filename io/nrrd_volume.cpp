#include "io/nrrd_volume.h"

#include <NrrdIO.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/bad_file.h"
#include "io/data_files.h"
#include "io/length_unit.h"
#include "io/nrrd_text.h"
#include "io/stored_samples.h"
#include "io/volume_checks.h"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/lsan_interface.h>
#endif

namespace nacre {
namespace {

#if defined(__SANITIZE_ADDRESS__)
/// For some damaged headers the library loses 88 bytes; a leak checker would count them as ours.
using LeaksAreTheLibrarys = __lsan::ScopedDisabler;
#else
struct LeaksAreTheLibrarys {
  // A constructor, so that an object of it is not an unused variable.
  LeaksAreTheLibrarys() {}  // NOLINT(modernize-use-equals-default)
};
#endif

namespace fs = std::filesystem;

struct FreeNrrd {
  void operator()(Nrrd* nrrd) const noexcept { nrrdNuke(nrrd); }
  void operator()(NrrdIoState* state) const noexcept { nrrdIoStateNix(state); }
};

/// A parsed header, with what the library knows of the encoding.
struct Header {
  std::unique_ptr<Nrrd, FreeNrrd> nrrd;
  std::unique_ptr<NrrdIoState, FreeNrrd> state;
};

/// The innermost line of the library's chain of messages: what was wrong, without its call stack.
std::string library_message() {
  const std::unique_ptr<char, decltype(&std::free)> chain(biffGetDone(NRRD), std::free);
  std::string text = chain ? chain.get() : "unknown";
  while (!text.empty() && text.back() == '\n') text.pop_back();
  text.erase(0, text.rfind('\n') + 1);
  // "[nrrd] function: message"
  const std::size_t colon = text.find(": ");
  return colon == std::string::npos ? text : text.substr(colon + 2);
}

Header parse(const fs::path& path, const NrrdText& text) {
  const LeaksAreTheLibrarys leaks;
  Header header{std::unique_ptr<Nrrd, FreeNrrd>(nrrdNew()),
                std::unique_ptr<NrrdIoState, FreeNrrd>(nrrdIoStateNew())};
  nrrdIoStateSet(header.state.get(), nrrdIoStateSkipData, 1);
  if (nrrdStringRead(header.nrrd.get(), text.fields.c_str(), header.state.get()) != 0) {
    throw_bad_file(path, "a damaged header (" + printable(library_message()) + ")", "NRRD");
  }
  return header;
}

StoredType stored_type(const fs::path& path, int type) {
  switch (type) {
    case nrrdTypeChar: return StoredType::I8;
    case nrrdTypeUChar: return StoredType::U8;
    case nrrdTypeShort: return StoredType::I16;
    case nrrdTypeUShort: return StoredType::U16;
    case nrrdTypeInt: return StoredType::I32;
    case nrrdTypeUInt: return StoredType::U32;
    case nrrdTypeLLong: return StoredType::I64;
    case nrrdTypeULLong: return StoredType::U64;
    case nrrdTypeFloat: return StoredType::F32;
    case nrrdTypeDouble: return StoredType::F64;
    default: break;
  }
  throw_bad_file(path, fmt::format("samples of type {}", airEnumStr(nrrdType, type)),
                 "integers or real numbers");
}

/// True if every component of a vector in the file's space was given.
bool is_given(const Nrrd& nrrd, const double* vector) {
  return nrrd.spaceDim > 0 &&
         std::all_of(vector, vector + nrrd.spaceDim, [](double c) { return !std::isnan(c); });
}

bool has_direction(const Nrrd& nrrd, unsigned axis) {
  return is_given(nrrd, nrrd.axis[axis].spaceDirection);
}

bool has_any_direction(const Nrrd& nrrd) {
  for (unsigned axis = 0; axis < nrrd.dim; ++axis) {
    if (has_direction(nrrd, axis)) return true;
  }
  return false;
}

/// Refuses an axis that counts components (colour, complex, vector) or time, not places.
void check_axis_is_spatial(const fs::path& path, const Nrrd& nrrd, unsigned axis) {
  const NrrdAxisInfo& info = nrrd.axis[axis];
  const bool spatial =
      info.kind == nrrdKindUnknown || info.kind == nrrdKindDomain || info.kind == nrrdKindSpace;
  if (!spatial) {
    throw_bad_file(path,
                   fmt::format("an axis of kind {} with {} samples",
                               airEnumStr(nrrdKind, info.kind), info.size),
                   "scalar samples on spatial axes");
  }
  if (has_any_direction(nrrd) && !has_direction(nrrd, axis)) {
    throw_bad_file(path, fmt::format("axis {} with {} samples and no direction", axis, info.size),
                   "scalar samples on spatial axes");
  }
}

/// The two or three axes of the volume. Others may hold one sample: then they say nothing.
std::vector<unsigned> spatial_axes(const fs::path& path, const Nrrd& nrrd) {
  std::vector<unsigned> axes;
  std::string sizes;
  for (unsigned axis = 0; axis < nrrd.dim; ++axis) {
    const NrrdAxisInfo& info = nrrd.axis[axis];
    sizes += (axis > 0 ? " x " : "") + std::to_string(info.size);
    const bool placeholder =
        info.size == 1 && ((has_any_direction(nrrd) && !has_direction(nrrd, axis)) ||
                           (info.kind != nrrdKindUnknown && nrrdKindIsDomain(info.kind) == 0));
    if (placeholder) continue;
    if (info.size > 1) check_axis_is_spatial(path, nrrd, axis);
    axes.push_back(axis);
  }
  for (std::size_t i = axes.size(); i-- > 0 && axes.size() > 3;) {
    if (nrrd.axis[axes[i]].size == 1) axes.erase(axes.begin() + static_cast<std::ptrdiff_t>(i));
  }
  if (axes.size() < 2 || axes.size() > 3) {
    throw_bad_file(path, fmt::format("{} dimensions ({})", axes.size(), sizes),
                   "one volume of 3 dimensions, or a slice of 2");
  }
  return axes;
}

/// Signs that take the file's space to LPS.
glm::dvec3 lps_signs(int space, VolumeReadReport& report) {
  switch (space) {
    case nrrdSpaceRightAnteriorSuperior: return {-1.0, -1.0, 1.0};
    case nrrdSpaceLeftAnteriorSuperior: return {1.0, -1.0, 1.0};
    case nrrdSpaceLeftPosteriorSuperior:
    case nrrdSpaceScannerXYZ: return {1.0, 1.0, 1.0};
    default: break;
  }
  report.warnings.emplace_back("the file names no patient space: coordinates taken as L, P, S");
  return {1.0, 1.0, 1.0};
}

glm::dmat4 matrix_from_directions(const fs::path& path, const Nrrd& nrrd,
                                  const std::vector<unsigned>& axes, VolumeReadReport& report) {
  if (nrrd.spaceDim > 3) {
    throw_bad_file(path, fmt::format("a space of {} dimensions", nrrd.spaceDim), "3");
  }
  const glm::dvec3 signs = lps_signs(nrrd.space, report);
  const bool has_origin = is_given(nrrd, nrrd.spaceOrigin);
  glm::dmat4 matrix(1.0);
  for (unsigned row = 0; row < nrrd.spaceDim; ++row) {
    const double unit = mm_per_unit(nrrd.spaceUnits[row], report);
    const int r = static_cast<int>(row);
    for (std::size_t column = 0; column < axes.size(); ++column) {
      // + 0.0: no negative zeros.
      matrix[static_cast<int>(column)][r] =
          signs[r] * unit * nrrd.axis[axes[column]].spaceDirection[row] + 0.0;
    }
    if (has_origin) matrix[3][r] = signs[r] * unit * nrrd.spaceOrigin[row] + 0.0;
  }
  if (axes.size() == 2) {
    const glm::dvec3 normal = glm::cross(glm::dvec3(matrix[0]), glm::dvec3(matrix[1]));
    matrix[2] = glm::dvec4(normal / glm::length(normal), 0.0);
  }
  return matrix;
}

glm::dmat4 matrix_from_spacings(const fs::path& path, const Nrrd& nrrd,
                                const std::vector<unsigned>& axes, VolumeReadReport& report) {
  report.warnings.emplace_back("the file states no orientation: axes assumed to run L, P, S");
  glm::dmat4 matrix(1.0);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const NrrdAxisInfo& info = nrrd.axis[axes[i]];
    const int axis = static_cast<int>(i);
    double spacing = info.spacing;
    if (std::isnan(spacing) && std::isfinite(info.min) && std::isfinite(info.max) &&
        info.size > 1) {
      const double steps = static_cast<double>(info.size) - (info.center == nrrdCenterCell ? 0 : 1);
      spacing = (info.max - info.min) / steps;
    }
    if (std::isnan(spacing)) {
      report.warnings.push_back(fmt::format("no spacing along axis {}: taken as 1 mm", axis));
      spacing = 1.0;
    }
    if (!(spacing > 0.0)) {
      throw_bad_file(path, fmt::format("a spacing of {} along axis {}", spacing, axis),
                     "a positive one");
    }
    const double unit = mm_per_unit(info.units, report);
    matrix[axis][axis] = unit * spacing;
    if (std::isfinite(info.min)) {
      matrix[3][axis] = unit * (info.min + (info.center == nrrdCenterCell ? 0.5 * spacing : 0.0));
    }
  }
  return matrix;
}

std::vector<Stretch> pieces(const fs::path& path, const NrrdText& text, const NrrdIoState& state) {
  const std::string encoding = state.encoding->name;
  if (encoding != "raw" && encoding != "gzip") {
    throw_bad_file(path, "encoding " + encoding, "raw or gzip");
  }
  std::vector<Stretch> stretches;
  for (const fs::path& file : text.data_files) {
    Stretch stretch{.path = file, .offset = text.end};
    file_size_of(file);
    if (state.lineSkip > 0) {
      stretch.offset = offset_after_lines(file, stretch.offset, state.lineSkip);
    }
    if (encoding == "gzip") stretch.packing = Packing::Deflated;
    if (state.byteSkip > 0) {
      (encoding == "gzip" ? stretch.skip : stretch.offset) +=
          static_cast<std::uint64_t>(state.byteSkip);
    }
    stretches.push_back(stretch);
  }
  return stretches;
}

}  // namespace

Volume read_nrrd(const fs::path& path, VolumeReadReport& report) {
  report.format = "NRRD";
  const NrrdText text = read_nrrd_text(path);
  const Header header = parse(path, text);
  const Nrrd& nrrd = *header.nrrd;

  StoredSamples stored;
  stored.type = stored_type(path, nrrd.type);
  stored.big_endian = header.state->endian == airEndianBig;
  const std::vector<unsigned> axes = spatial_axes(path, nrrd);
  stored.dims = glm::i64vec3(1);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    stored.dims[static_cast<int>(i)] = static_cast<std::int64_t>(nrrd.axis[axes[i]].size);
  }
  const glm::dmat4 world_from_voxel = has_any_direction(nrrd)
                                          ? matrix_from_directions(path, nrrd, axes, report)
                                          : matrix_from_spacings(path, nrrd, axes, report);
  check_geometry(path, world_from_voxel, report);
  stored.pieces = pieces(path, text, *header.state);
  stored.at_file_end = header.state->byteSkip == -1;
  Volume volume = read_stored_samples(path, stored, report);
  volume.world_from_voxel = world_from_voxel;
  return volume;
}

}  // namespace nacre
