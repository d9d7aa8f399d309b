#include "io/nrrd_writer.h"

#include <fmt/core.h>

#include <bit>
#include <optional>
#include <span>
#include <string>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/gzip_writer.h"

namespace nacre {
namespace {

const char* type_name(ScalarType type) {
  switch (type) {
    case ScalarType::U8: return "uint8";
    case ScalarType::I8: return "int8";
    case ScalarType::U16: return "uint16";
    case ScalarType::I16: return "int16";
    case ScalarType::U32: return "uint32";
    case ScalarType::I32: return "int32";
    case ScalarType::F32: return "float";
    case ScalarType::F64: break;
  }
  return "double";
}

/// Numbers as short as reads back to the same double.
std::string vector_text(const glm::dvec4& v) { return fmt::format("({},{},{})", v.x, v.y, v.z); }

/// All fields but where the samples are.
std::string header_text(const Volume& volume) {
  const glm::dmat4& m = volume.world_from_voxel;
  std::string text = "NRRD0004\n";
  text += fmt::format("type: {}\ndimension: 3\nspace: left-posterior-superior\n",
                      type_name(volume.type));
  text += fmt::format("sizes: {} {} {}\n", volume.dims.x, volume.dims.y, volume.dims.z);
  text += fmt::format("space directions: {} {} {}\n", vector_text(m[0]), vector_text(m[1]),
                      vector_text(m[2]));
  text += "kinds: domain domain domain\n";
  text +=
      fmt::format("endian: {}\n", std::endian::native == std::endian::little ? "little" : "big");
  text += fmt::format("space origin: {}\n", vector_text(m[3]));
  return text;
}

}  // namespace

void write_nrrd(const Volume& volume, const std::filesystem::path& path) {
  if (volume.slope != 1.0 || volume.intercept != 0.0) {
    throw Error(
        ErrorCode::Unsupported,
        fmt::format("{}: found slope {} and intercept {}, expected 1 and 0: NRRD cannot say "
                    "others (.nii and .mha can)",
                    path.string(), volume.slope, volume.intercept));
  }
  const std::span<const std::byte> samples(volume.samples.data(), volume.samples.size());
  const bool detached = path.extension() == ".nhdr" || path.extension() == ".NHDR";
  AtomicFile file(path);
  file.write(header_text(volume));
  if (detached) {
    const std::filesystem::path raw_path = std::filesystem::path(path).replace_extension(".raw");
    AtomicFile raw(raw_path);
    raw.write(samples);
    file.write(fmt::format("encoding: raw\ndata file: {}\n", raw_path.filename().string()));
    raw.commit();
  } else {
    file.write(std::string_view("encoding: gzip\n\n"));
    GzipWriter gzip(file);
    gzip.write(samples);
    gzip.finish();
  }
  file.commit();
}

}  // namespace nacre
