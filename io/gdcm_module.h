#pragma once

#include <cstddef>

namespace nacre {

struct DicomSlice;

/// The functions of the module nacre_gdcm, which is loaded where a DICOM file is read: GDCM's
/// dictionaries take more memory and time to set up than all else in a start (see
/// docs/decisions/023). Both may throw or end the process on a damaged file: call them in a
/// ChildProcess.
struct GdcmModule {
  /// What a file says about its image; false if it is no DICOM file or has no image.
  /// @param certainly_dicom  the file has the mark of one: unreadable is an error then
  /// @throws std::runtime_error  where a file that is certainly DICOM cannot be read
  bool (*describe)(const char* path, bool certainly_dicom, DicomSlice* slice) = nullptr;

  /// Decodes the samples of a file, `size` bytes.
  /// @throws std::runtime_error  where they cannot be decoded, or are not as many
  void (*decode)(const char* path, std::byte* samples, std::size_t size) = nullptr;
};

/// Loads the module, found by the run path of the program: beside the build's or the installation's
/// libraries. It stays loaded.
/// @throws Error  Unsupported if it is not there, or is another version's
GdcmModule load_gdcm();

}  // namespace nacre

extern "C" {
/// See GdcmModule::describe.
bool nacre_gdcm_describe(const char* path, bool certainly_dicom, nacre::DicomSlice* slice);
/// See GdcmModule::decode.
void nacre_gdcm_decode(const char* path, std::byte* samples, std::size_t size);
}
