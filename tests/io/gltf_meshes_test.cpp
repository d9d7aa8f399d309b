// Meshes of .glb files that others wrote: plain accessors of all index types, and what is refused.
#include "io/gltf_meshes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "io/shell_writer.h"
#include "tests/io/small_shell_set.h"
#include "tests/support/analytic_surfaces.h"
#include "tests/support/expect_error.h"
#include "tests/support/scratch_folder.h"

namespace nacre {
namespace {

using nlohmann::json;
using testing::bytes_of;
using testing::expect_error;
using testing::ScratchFolder;

std::string chunk(const std::string& data, const char* type, char filler) {
  std::string padded = data;
  padded.resize((data.size() + 3) / 4 * 4, filler);
  const auto size = static_cast<std::uint32_t>(padded.size());
  std::string bytes(reinterpret_cast<const char*>(&size), sizeof(size));
  return bytes + std::string(type, 4) + padded;
}

std::string glb(const json& gltf, const std::string& binary) {
  const std::string chunks = chunk(gltf.dump(), "JSON", ' ') + chunk(binary, "BIN", '\0');
  const auto size = static_cast<std::uint32_t>(chunks.size() + 12);
  const std::uint32_t version = 2;
  std::string header = "glTF";
  header.append(reinterpret_cast<const char*>(&version), 4);
  header.append(reinterpret_cast<const char*>(&size), 4);
  return header + chunks;
}

/// A cube's file with indices of some type.
template <class Index>
std::pair<json, std::string> cube_file(int component) {
  const TriangleMesh cube = testing::cube_surface(1.0F);
  std::string positions(cube.positions.size() * 12, '\0');
  std::memcpy(positions.data(), cube.positions.data(), positions.size());
  std::vector<Index> indices;
  for (const glm::uvec3& t : cube.triangles) {
    for (int i = 0; i < 3; ++i) indices.push_back(static_cast<Index>(t[i]));
  }
  const std::string binary = positions + bytes_of(indices);
  const json gltf = {
      {"asset", {{"version", "2.0"}}},
      {"buffers", {{{"byteLength", binary.size()}}}},
      {"bufferViews",
       {{{"buffer", 0}, {"byteLength", positions.size()}},
        {{"buffer", 0},
         {"byteOffset", positions.size()},
         {"byteLength", bytes_of(indices).size()}}}},
      {"accessors",
       {{{"bufferView", 0}, {"componentType", 5126}, {"count", 8}, {"type", "VEC3"}},
        {{"bufferView", 1}, {"componentType", component}, {"count", 36}, {"type", "SCALAR"}}}},
      {"meshes",
       {{{"name", "cube"},
         {"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}}};
  return {gltf, binary};
}

class GltfMeshesTest : public ::testing::Test {
 protected:
  std::filesystem::path write(const json& gltf, const std::string& binary) const {
    return folder_.write("file.glb", glb(gltf, binary));
  }
  template <class Index>
  void expect_cube(int component) const {
    const auto [gltf, binary] = cube_file<Index>(component);
    const GltfMeshes file = read_gltf_meshes(write(gltf, binary));
    EXPECT_FALSE(file.is_shell_set);
    ASSERT_EQ(file.meshes.size(), 1u);
    EXPECT_EQ(file.meshes[0].name, "cube");
    EXPECT_EQ(file.meshes[0].surface.triangles, testing::cube_surface(1.0F).triangles);
    EXPECT_EQ(file.meshes[0].surface.positions, testing::cube_surface(1.0F).positions);
  }
  /// The cube's file, changed, is refused.
  template <class Change>
  void expect_refusal(ErrorCode code, const std::string& part, Change change) const {
    auto [gltf, binary] = cube_file<std::uint16_t>(5123);
    change(gltf);
    const auto path = write(gltf, binary);
    expect_error(code, part, [&] { read_gltf_meshes(path); });
    expect_error(code, path.string(), [&] { read_gltf_meshes(path); });
  }

  ScratchFolder folder_;
};

TEST_F(GltfMeshesTest, ReadsIndicesOfAllTypes) {
  expect_cube<std::uint8_t>(5121);
  expect_cube<std::uint16_t>(5123);
  expect_cube<std::uint32_t>(5125);
}

TEST_F(GltfMeshesTest, WithoutIndicesTakesVerticesInOrder) {
  auto [gltf, binary] = cube_file<std::uint8_t>(5121);
  gltf["meshes"][0]["primitives"][0].erase("indices");
  gltf["accessors"][0]["count"] = 6;
  const GltfMeshes file = read_gltf_meshes(write(gltf, binary));
  EXPECT_EQ(file.meshes[0].surface.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {3, 4, 5}}));
}

TEST_F(GltfMeshesTest, LeavesLinesOut) {
  auto [gltf, binary] = cube_file<std::uint8_t>(5121);
  gltf["meshes"][0]["primitives"][0]["mode"] = 1;
  const GltfMeshes file = read_gltf_meshes(write(gltf, binary));
  EXPECT_TRUE(file.meshes.empty());
  EXPECT_EQ(file.left_out, 1u);
}

TEST_F(GltfMeshesTest, ReadsWhatTheWriterWrites) {
  const ShellSet set = testing::small_shell_set();
  write_shell_set(folder_.path() / "set.glb", set);
  EXPECT_TRUE(is_shell_file(folder_.path() / "set.glb"));
  const GltfMeshes file = read_gltf_meshes(folder_.path() / "set.glb");
  EXPECT_TRUE(file.is_shell_set);
  ASSERT_EQ(file.meshes.size(), 3u);
  EXPECT_EQ(file.meshes[0].surface.triangles.size(), set.shells[0].surface.triangles.size());
}

TEST_F(GltfMeshesTest, TrustsNothing) {
  expect_refusal(ErrorCode::BadFile, "within",
                 [](json& g) { g["bufferViews"][0]["byteLength"] = 9999; });
  expect_refusal(ErrorCode::BadFile, "within", [](json& g) { g["accessors"][0]["count"] = 9; });
  expect_refusal(ErrorCode::BadFile, "within",
                 [](json& g) { g["accessors"][0]["byteOffset"] = 4; });
  expect_refusal(ErrorCode::BadFile, "count", [](json& g) { g["accessors"][0]["count"] = -1; });
  expect_refusal(ErrorCode::BadFile, "count", [](json& g) { g["accessors"][0]["count"] = 1e18; });
  expect_refusal(ErrorCode::BadFile, "three a triangle",
                 [](json& g) { g["accessors"][1]["count"] = 35; });
  expect_refusal(ErrorCode::BadFile, "below 4", [](json& g) { g["accessors"][0]["count"] = 4; });
  expect_refusal(ErrorCode::BadFile, "hold together",
                 [](json& g) { g["accessors"][0]["bufferView"] = 7; });
  expect_refusal(ErrorCode::BadFile, "hold together", [](json& g) { g.erase("accessors"); });
  expect_refusal(ErrorCode::BadFile, "hold together",
                 [](json& g) { g["meshes"][0].erase("primitives"); });
  expect_refusal(ErrorCode::Unsupported, "sparse",
                 [](json& g) { g["accessors"][0]["sparse"] = json::object(); });
  expect_refusal(ErrorCode::Unsupported, "outside the file",
                 [](json& g) { g["buffers"][0]["uri"] = "a.bin"; });
  expect_refusal(ErrorCode::Unsupported, "three floats",
                 [](json& g) { g["accessors"][0]["componentType"] = 5122; });
}

TEST_F(GltfMeshesTest, RefusesWhatIsNoGlb) {
  const auto path = folder_.write("text.glb", "nothing");
  expect_error(ErrorCode::BadFile, "text.glb", [&] { read_gltf_meshes(path); });
  expect_error(ErrorCode::BadFile, "none.glb", [&] { is_shell_file(folder_.path() / "none.glb"); });
}

}  // namespace
}  // namespace nacre
