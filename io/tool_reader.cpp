#include "io/tool_reader.h"

#include <fmt/core.h>

#include "io/bad_file.h"
#include "io/byte_source.h"
#include "io/openmesh_reader.h"

namespace nacre {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 31;  // OpenMesh counts in int
constexpr const char* kKnown = "a tool mesh (.stl, .obj, .ply or .off)";

MeshFormat format_of(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw_bad_file(path, "a folder, perhaps a DICOM series", kKnown);
  }
  if (const auto format = mesh_format(path)) return *format;
  const std::string_view other = kind_by_ending(path);
  throw_bad_file(path,
                 other.empty()
                     ? fmt::format("the ending \"{}\"", printable(path.extension().string()))
                     : std::string(other),
                 kKnown);
}

std::string bytes_of(const std::filesystem::path& path) {
  const FileSource source(path);
  if (source.size() > kMostBytes) {
    throw_bad_file(path, fmt::format("{} bytes", source.size()),
                   fmt::format("at most {} for a tool mesh", kMostBytes));
  }
  const std::vector<std::byte> bytes = source.read(0, static_cast<std::size_t>(source.size()));
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

PlainMesh plain_mesh(const std::filesystem::path& path, MeshFormat format, std::string bytes) {
  switch (format) {
    case MeshFormat::Stl: return plain_stl(path, std::move(bytes));
    case MeshFormat::Obj: return plain_obj(path, std::move(bytes));
    case MeshFormat::Ply: return plain_ply(path, bytes);
    case MeshFormat::Off: break;
  }
  return plain_off(path, bytes);
}

}  // namespace

Tool read_tool(const std::filesystem::path& path) {
  const MeshFormat format = format_of(path);
  std::string bytes = bytes_of(path);
  if (bytes.empty()) throw_bad_file(path, "an empty file", kKnown);
  const std::string_view other = known_as_something_else(bytes, format);
  if (!other.empty()) throw_bad_file(path, std::string(other), kKnown);
  Tool tool;
  tool.name = path.filename().string();
  tool.mesh = read_with_openmesh(path, format, plain_mesh(path, format, std::move(bytes)));
  if (tool.mesh.triangles.empty()) throw_bad_file(path, "a mesh without triangles", "some");
  return tool;
}

}  // namespace nacre
