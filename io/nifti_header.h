#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <optional>

namespace nacre {

/// What a NIfTI header says, in the machine's byte order, checked as far as one field alone can be.
struct NiftiHeader {
  int version = 1;          ///< 1 or 2
  bool single_file = true;  ///< samples follow in the same file
  bool big_endian = false;
  std::array<std::int64_t, 8> dim{};  ///< [0] is the number of dimensions; unused ones are 1
  std::array<double, 8> pixdim{};
  int datatype = 0;          ///< DT_ code of nifti1.h
  std::uint64_t offset = 0;  ///< of the samples in their file
  double slope = 1.0;
  double intercept = 0.0;
  double mm_per_unit = 1.0;
  /// RAS from voxel indices, in the file's unit; nothing where the form's code is not positive.
  std::optional<glm::dmat4> sform;
  std::optional<glm::dmat4> qform;
};

/// Reads the header of a file (gzipped or not) through the NIfTI C library.
/// @throws Error  BadFile
NiftiHeader read_nifti_header(const std::filesystem::path& path);

/// "INT16", "RGB24", ...: the library's name of a DT_ code.
const char* nifti_type_name(int datatype);

}  // namespace nacre
