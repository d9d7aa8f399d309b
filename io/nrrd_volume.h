#pragma once

#include <filesystem>

#include "core/volume.h"
#include "io/volume_read_report.h"

namespace nacre {

/// Reads an NRRD volume: .nrrd, or .nhdr with its data files; raw or gzip encoding.
///
/// Spaces RAS, LAS and LPS become LPS; a file that names none is taken as LPS, with the axes along
/// it where it has no directions either. Units that the file gives (m, cm, um, ...) become mm.
///
/// @throws Error  BadFile for what is damaged, has more than three axes of more than one sample,
///                holds colours, vectors or complex numbers, or is encoded in another way;
///                Unsupported in a build without ITK
Volume read_nrrd(const std::filesystem::path& path, VolumeReadReport& report);

}  // namespace nacre
