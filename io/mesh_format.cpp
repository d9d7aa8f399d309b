#include "io/mesh_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "io/tool_reader.h"

namespace nacre {
namespace {

struct Ending {
  std::string_view ending;
  std::string_view kind;
};

constexpr std::array<Ending, 17> kOtherKinds{{
    {".nii", "a NIfTI volume"},
    {".nii.gz", "a NIfTI volume"},
    {".hdr", "a NIfTI volume"},
    {".img", "a NIfTI volume"},
    {".nrrd", "an NRRD volume"},
    {".nhdr", "an NRRD volume"},
    {".mha", "a MetaImage volume"},
    {".mhd", "a MetaImage volume"},
    {".dcm", "a DICOM file"},
    {".raw", "a raw volume"},
    {".glb", "a .glb shell set"},
    {".gltf", "a .gltf scene"},
    {".html", "a viewer page"},
    {".png", "a picture"},
    {".tif", "a picture"},
    {".tiff", "a picture"},
    {".mtl", "an OBJ's materials"},
}};

struct Magic {
  std::size_t offset;
  std::string_view bytes;
  std::string_view kind;
};

// NIfTI's sizeof_hdr, 348 or 540, is four bytes, little-endian in all but very old files.
constexpr std::array<Magic, 11> kMagics{{
    {0, "glTF", "a .glb shell set"},
    {0, "NRRD", "an NRRD volume"},
    {0, "ObjectType = Image", "a MetaImage volume"},
    {128, "DICM", "a DICOM file"},
    {344, "n+1", "a NIfTI volume"},
    {344, "ni1", "a NIfTI volume"},
    {4, "n+2", "a NIfTI volume"},
    {0, "\x1f\x8b", "a gzip file, perhaps a volume"},
    {0, "\x89PNG", "a picture"},
    {0, "# vtk DataFile", "a VTK file"},
    {0, "PK\x03\x04", "a zip archive"},
}};

std::string lower_name(const std::filesystem::path& path) {
  std::string name = path.filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

}  // namespace

std::optional<MeshFormat> mesh_format(const std::filesystem::path& path) {
  const std::string name = lower_name(path);
  if (name.ends_with(".stl") || name.ends_with(".stla") || name.ends_with(".stlb")) {
    return MeshFormat::Stl;
  }
  if (name.ends_with(".obj")) return MeshFormat::Obj;
  if (name.ends_with(".ply")) return MeshFormat::Ply;
  if (name.ends_with(".off")) return MeshFormat::Off;
  return std::nullopt;
}

std::string_view known_as_something_else(std::string_view bytes, MeshFormat format) {
  for (const Magic& magic : kMagics) {
    if (bytes.size() > magic.offset && bytes.substr(magic.offset).starts_with(magic.bytes)) {
      return magic.kind;
    }
  }
  const bool is_ply = bytes.starts_with("ply\n") || bytes.starts_with("ply\r");
  return is_ply && format != MeshFormat::Ply ? "a PLY mesh" : std::string_view{};
}

std::string_view kind_by_ending(const std::filesystem::path& path) {
  const std::string name = lower_name(path);
  for (const Ending& other : kOtherKinds) {
    if (name.ends_with(other.ending)) return other.kind;
  }
  return {};
}

bool is_tool_name(const std::filesystem::path& path) { return mesh_format(path).has_value(); }

}  // namespace nacre
