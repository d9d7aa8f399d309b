#pragma once

#include <filesystem>

namespace nacre {

/// True if the file begins as DICOM files do: "DICM" after 128 bytes of anything.
bool has_dicom_magic(const std::filesystem::path& path);

}  // namespace nacre
