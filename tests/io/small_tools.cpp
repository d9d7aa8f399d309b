#include "tests/io/small_tools.h"

#include <fmt/core.h>

#include <cstdint>

#include "tests/support/scratch_folder.h"

namespace nacre::testing {
namespace {

std::string ply_header(const TriangleMesh& mesh, std::string_view encoding) {
  return fmt::format(
      "ply\nformat {} 1.0\ncomment a small tool\nelement vertex {}\nproperty float x\nproperty "
      "float y\nproperty float z\nelement face {}\nproperty list uchar int vertex_indices\n"
      "end_header\n",
      encoding, mesh.positions.size(), mesh.triangles.size());
}

}  // namespace

TriangleMesh small_tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

std::string binary_stl(const TriangleMesh& mesh) {
  ByteBlock block(84 + 50 * mesh.triangles.size(), false);
  block.put_text(0, "a small tool");
  block.put(80, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      for (int axis = 0; axis < 3; ++axis) {
        block.put(84 + 50 * t + 12 * (1 + static_cast<std::size_t>(corner)) +
                      4 * static_cast<std::size_t>(axis),
                  mesh.positions[mesh.triangles[t][corner]][axis]);
      }
    }
  }
  return block.bytes();
}

std::string ascii_stl(const TriangleMesh& mesh) {
  std::string text = "solid small tool\n";
  for (const glm::uvec3& triangle : mesh.triangles) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (int i = 0; i < 3; ++i) {
      const glm::vec3& p = mesh.positions[triangle[i]];
      text += fmt::format("      vertex {} {} {}\n", p.x, p.y, p.z);
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid\n";
}

std::string obj_text(const TriangleMesh& mesh) {
  std::string text = "# a small tool\no tool\n";
  for (const glm::vec3& p : mesh.positions) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const glm::uvec3& t : mesh.triangles) {
    text += fmt::format("f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
  }
  return text;
}

std::string off_text(const TriangleMesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.positions.size(), mesh.triangles.size());
  for (const glm::vec3& p : mesh.positions) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (const glm::uvec3& t : mesh.triangles) text += fmt::format("3 {} {} {}\n", t.x, t.y, t.z);
  return text;
}

std::string ascii_ply(const TriangleMesh& mesh) {
  std::string text = ply_header(mesh, "ascii");
  for (const glm::vec3& p : mesh.positions) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (const glm::uvec3& t : mesh.triangles) text += fmt::format("3 {} {} {}\n", t.x, t.y, t.z);
  return text;
}

std::string binary_ply(const TriangleMesh& mesh, bool big_endian) {
  std::string bytes = ply_header(mesh, big_endian ? "binary_big_endian" : "binary_little_endian");
  for (const glm::vec3& p : mesh.positions) {
    bytes += bytes_of(std::vector<float>{p.x, p.y, p.z}, big_endian);
  }
  for (const glm::uvec3& t : mesh.triangles) {
    bytes += '\3';
    bytes += bytes_of(std::vector<std::uint32_t>{t.x, t.y, t.z}, big_endian);
  }
  return bytes;
}

std::string with_line_ends(std::string_view text, std::string_view end) {
  std::string changed;
  for (const char c : text) {
    if (c == '\n') {
      changed += end;
    } else {
      changed += c;
    }
  }
  return changed;
}

}  // namespace nacre::testing
