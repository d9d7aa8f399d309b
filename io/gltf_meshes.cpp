#include "io/gltf_meshes.h"

#include <fmt/core.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>

#include "core/error.h"
#include "io/byte_source.h"
#include "io/draco_decode.h"
#include "io/glb_container.h"
#include "io/json_depth.h"
#include "io/shell_file_format.h"

namespace nacre {
namespace {

using nlohmann::json;

constexpr int kComponentUint8 = 5121;
constexpr int kComponentUint16 = 5123;
constexpr std::size_t kMaxCount = std::size_t{1} << 32;

[[noreturn]] void reject(const std::string& what) { throw Error(ErrorCode::BadFile, what); }
[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorCode::Unsupported, what); }

/// A count or an index of the file.
std::size_t count_of(const json& value) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= kMaxCount) {
    reject(fmt::format("found {:.40}, expected a count", value.dump()));
  }
  return value.get<std::size_t>();
}

std::size_t count_or(const json& object, const char* key, std::size_t otherwise) {
  return object.contains(key) ? count_of(object.at(key)) : otherwise;
}

class GltfFile {
 public:
  explicit GltfFile(const std::filesystem::path& path)
      : source_(path), container_(read_glb_container(source_, path.string())) {
    if (is_json_too_deep(container_.json)) reject("found JSON nested too deeply, expected glTF");
    gltf_ = json::parse(container_.json);
    if (!gltf_.is_object() || !gltf_.contains("asset")) reject("found other JSON, expected glTF");
    gltf_.emplace("meshes", json::array());  // unless it has some
  }

  bool is_shell_set() const {
    if (!gltf_.contains("nodes")) return false;
    for (const json& node : gltf_.at("nodes")) {
      if (node.contains("extras") && node.at("extras").contains("nacre")) return true;
    }
    return false;
  }

  const json& meshes() const { return gltf_.at("meshes"); }

  TriangleMesh surface(const json& primitive) const {
    const json& positions = accessor(primitive.at("attributes").at("POSITION"));
    if (primitive.contains("extensions") &&
        primitive.at("extensions").contains(shell_file::kDracoExtension)) {
      return draco(primitive, positions);
    }
    TriangleMesh mesh;
    mesh.positions = read_positions(positions);
    mesh.triangles =
        triangles_of(primitive.contains("indices") ? read_indices(accessor(primitive.at("indices")))
                                                   : counted_up(mesh.positions.size()),
                     mesh.positions.size());
    return mesh;
  }

 private:
  const json& accessor(const json& index) const {
    const json& found = gltf_.at("accessors").at(count_of(index));
    if (found.contains("sparse")) refuse("found a sparse accessor, expected a plain one");
    return found;
  }

  /// The bytes of a buffer view, all of them in the binary chunk.
  std::vector<std::byte> view_bytes(const json& view) const {
    if (count_of(view.at("buffer")) != 0 || gltf_.at("buffers").at(0).contains("uri")) {
      refuse("found a buffer outside the file, expected the file's own");
    }
    const std::size_t offset = count_or(view, "byteOffset", 0);
    const std::size_t size = count_of(view.at("byteLength"));
    if (offset > container_.binary_size || size > container_.binary_size - offset) {
      reject(fmt::format("found {} bytes at {}, expected them within the {} of the binary chunk",
                         size, offset, container_.binary_size));
    }
    return source_.read(container_.binary_offset + offset, size);
  }

  /// The elements of an accessor, one behind the other.
  std::vector<std::byte> element_bytes(const json& accessor, std::size_t element) const {
    if (!accessor.contains("bufferView")) reject("found an accessor without data, expected some");
    const json& view = gltf_.at("bufferViews").at(count_of(accessor.at("bufferView")));
    const std::vector<std::byte> bytes = view_bytes(view);
    const std::size_t count = count_of(accessor.at("count"));
    const std::size_t stride = count_or(view, "byteStride", element);
    const std::size_t begin = count_or(accessor, "byteOffset", 0);
    const bool fits = count == 0 || (stride >= element && begin + element <= bytes.size() &&
                                     count - 1 <= (bytes.size() - begin - element) / stride);
    if (!fits) {
      reject(fmt::format("found an accessor of {} elements, expected it within its {} bytes", count,
                         bytes.size()));
    }
    std::vector<std::byte> elements(count * element);
    for (std::size_t i = 0; i < count; ++i) {
      std::memcpy(elements.data() + i * element, bytes.data() + begin + i * stride, element);
    }
    return elements;
  }

  std::vector<glm::vec3> read_positions(const json& accessor) const {
    if (accessor.at("type") != "VEC3" ||
        accessor.at("componentType") != shell_file::kComponentFloat) {
      refuse("found other positions, expected three floats a vertex");
    }
    const std::vector<std::byte> bytes = element_bytes(accessor, sizeof(glm::vec3));
    std::vector<glm::vec3> positions(bytes.size() / sizeof(glm::vec3));
    std::memcpy(positions.data(), bytes.data(), bytes.size());
    for (const glm::vec3& p : positions) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        reject(fmt::format("found a vertex at ({}, {}, {}), expected finite positions", p.x, p.y,
                           p.z));
      }
    }
    return positions;
  }

  template <class Index>
  std::vector<std::uint32_t> indices_as(const json& accessor) const {
    const std::vector<std::byte> bytes = element_bytes(accessor, sizeof(Index));
    std::vector<std::uint32_t> indices(bytes.size() / sizeof(Index));
    for (std::size_t i = 0; i < indices.size(); ++i) {
      Index index{};
      std::memcpy(&index, bytes.data() + i * sizeof(Index), sizeof(Index));
      indices[i] = index;
    }
    return indices;
  }

  std::vector<std::uint32_t> read_indices(const json& accessor) const {
    const int type = accessor.at("componentType").get<int>();
    if (type == kComponentUint8) return indices_as<std::uint8_t>(accessor);
    if (type == kComponentUint16) return indices_as<std::uint16_t>(accessor);
    if (type == shell_file::kComponentUint32) return indices_as<std::uint32_t>(accessor);
    reject(fmt::format("found indices of component type {}, expected 5121, 5123 or 5125", type));
  }

  static std::vector<std::uint32_t> counted_up(std::size_t count) {
    std::vector<std::uint32_t> indices(count);
    for (std::size_t i = 0; i < count; ++i) indices[i] = static_cast<std::uint32_t>(i);
    return indices;
  }

  static std::vector<glm::uvec3> triangles_of(const std::vector<std::uint32_t>& indices,
                                              std::size_t vertices) {
    if (indices.size() % 3 != 0) {
      reject(fmt::format("found {} indices, expected three a triangle", indices.size()));
    }
    std::vector<glm::uvec3> triangles(indices.size() / 3);
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (indices[i] >= vertices) {
        reject(fmt::format("found vertex index {}, expected below {}", indices[i], vertices));
      }
      triangles[i / 3][static_cast<int>(i % 3)] = indices[i];
    }
    return triangles;
  }

  TriangleMesh draco(const json& primitive, const json& positions) const {
    const json& extension = primitive.at("extensions").at(shell_file::kDracoExtension);
    if (extension.at("attributes").size() != 1) {
      refuse("found Draco data with further attributes, expected positions only");
    }
    const json& view = gltf_.at("bufferViews").at(count_of(extension.at("bufferView")));
    const std::size_t indices = count_of(accessor(primitive.at("indices")).at("count"));
    return decode_draco(view_bytes(view), {indices / 3, count_of(positions.at("count"))});
  }

  FileSource source_;
  GlbContainer container_;
  json gltf_;
};

bool is_triangles(const json& primitive) {
  return count_or(primitive, "mode", shell_file::kModeTriangles) == shell_file::kModeTriangles;
}

std::string name_of(const json& mesh, std::size_t mesh_index, std::size_t primitive_index) {
  std::string name = fmt::format("mesh {}", mesh_index);
  if (mesh.contains("name") && mesh.at("name").is_string()) name = mesh.at("name");
  if (mesh.at("primitives").size() > 1) name += fmt::format(" part {}", primitive_index);
  return name;
}

GltfMeshes read_meshes(const GltfFile& file, const ProgressCallback& progress) {
  GltfMeshes result;
  result.is_shell_set = file.is_shell_set();
  ProgressMeter meter(progress, "decode", file.meshes().size());
  for (std::size_t i = 0; i < file.meshes().size(); ++i) {
    const json& mesh = file.meshes().at(i);
    const json& primitives = mesh.at("primitives");
    for (std::size_t j = 0; j < primitives.size(); ++j) {
      if (is_triangles(primitives.at(j))) {
        result.meshes.push_back({name_of(mesh, i, j), file.surface(primitives.at(j))});
      } else {
        ++result.left_out;
      }
    }
    meter.advance();
  }
  return result;
}

/// Calls `work` and puts the path before what it complains of; JSON that is not what glTF has there
/// is the file's fault.
template <class Work>
auto with_path(const std::filesystem::path& path, Work&& work) {
  const std::string name = path.string();
  try {
    return work();
  } catch (const json::exception& error) {
    throw Error(ErrorCode::BadFile,
                fmt::format("{}: found a structure that does not hold together ({:.120}), expected "
                            "glTF 2",
                            name, error.what()));
  } catch (const Error& error) {
    const std::string what = error.what();
    if (what.starts_with(name)) throw;
    throw Error(error.code(), fmt::format("{}: {}", name, what));
  }
}

}  // namespace

bool is_shell_file(const std::filesystem::path& path) {
  return with_path(path, [&] { return GltfFile(path).is_shell_set(); });
}

GltfMeshes read_gltf_meshes(const std::filesystem::path& path, const ProgressCallback& progress) {
  return with_path(path, [&] { return read_meshes(GltfFile(path), progress); });
}

}  // namespace nacre
