#include "io/tool_reader.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "core/mesh_summary.h"
#include "tests/io/small_tools.h"
#include "tests/support/expect_error.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test_data.h"

namespace nacre {
namespace {

using namespace testing;

class ToolReader : public ::testing::Test {
 protected:
  MeshSummary read(const std::string& name, const std::string& bytes) const {
    return summarize(read_tool(folder_.write(name, bytes)).mesh);
  }

  void expect_tetrahedron(const std::string& name, const std::string& bytes) const {
    const MeshSummary found = read(name, bytes);
    EXPECT_EQ(found.triangles, 4u) << name;
    EXPECT_EQ(found.vertices, 4u) << name;
    EXPECT_EQ(found.open_edges, 0u) << name;
    EXPECT_NEAR(found.signed_volume, 1.0 / 6.0, 1e-7) << name;
  }

  /// One line that begins with the path and holds `part`, and not a word on the streams.
  void expect_refusal(const std::string& name, const std::string& bytes,
                      const std::string& part) const {
    const auto path = folder_.write(name, bytes);
    ::testing::internal::CaptureStderr();
    ::testing::internal::CaptureStdout();
    expect_error(ErrorCode::BadFile, part, [&] { read_tool(path); });
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << name;
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "") << name;
  }

  const TriangleMesh mesh_ = small_tetrahedron();
  ScratchFolder folder_;
};

TEST_F(ToolReader, ReadsTheSameMeshFromEveryFormat) {
  expect_tetrahedron("a.stl", binary_stl(mesh_));
  expect_tetrahedron("b.STL", ascii_stl(mesh_));
  expect_tetrahedron("c.obj", obj_text(mesh_));
  expect_tetrahedron("d.off", off_text(mesh_));
  expect_tetrahedron("e.ply", ascii_ply(mesh_));
  expect_tetrahedron("f.ply", binary_ply(mesh_, false));
  expect_tetrahedron("g.Ply", binary_ply(mesh_, true));
}

TEST_F(ToolReader, ReadsAnyLineEnds) {
  for (const std::string end : {"\r\n", "\r"}) {
    expect_tetrahedron("a.stl", with_line_ends(ascii_stl(mesh_), end));
    expect_tetrahedron("a.obj", with_line_ends(obj_text(mesh_), end));
    expect_tetrahedron("a.off", with_line_ends(off_text(mesh_), end));
    expect_tetrahedron("a.ply", with_line_ends(ascii_ply(mesh_), end));
  }
}

TEST_F(ToolReader, NamesTheToolAfterItsFile) {
  const Tool tool = read_tool(folder_.write("my knife.stl", binary_stl(mesh_)));
  EXPECT_EQ(tool.name, "my knife.stl");
  EXPECT_EQ(tool.world_from_tool, glm::dmat4(1.0));
}

// What OpenMesh's own meshes would drop: a third triangle at an edge, the same triangle twice, and
// once more turned over.
TEST_F(ToolReader, KeepsTrianglesThatMakeAMeshNonManifold) {
  TriangleMesh mesh = mesh_;
  mesh.positions.push_back({1, 1, 1});
  mesh.triangles.push_back({0, 1, 4});
  mesh.triangles.push_back(mesh.triangles[0]);
  mesh.triangles.push_back({1, 2, 0});
  for (const auto& [name, bytes] :
       {std::pair{"a.stl", binary_stl(mesh)}, std::pair{"b.stl", ascii_stl(mesh)},
        std::pair{"c.obj", obj_text(mesh)}, std::pair{"d.off", off_text(mesh)},
        std::pair{"e.ply", ascii_ply(mesh)}, std::pair{"f.ply", binary_ply(mesh, true)}}) {
    const MeshSummary found = read(name, bytes);
    EXPECT_EQ(found.triangles, 7u) << name;
    EXPECT_EQ(found.non_manifold_edges, 3u) << name;
    EXPECT_EQ(found.open_edges, 2u) << name;
  }
}

TEST_F(ToolReader, FansPolygons) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0.5 1.5 0\nv 0 1 0\n";
  EXPECT_EQ(read("a.obj", corners + "f 1 2 3 4 5\n").triangles, 3u);
  EXPECT_EQ(read("b.off", "OFF\n4 1 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n").triangles, 2u);
  EXPECT_EQ(read("c.ply",
                 "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                 "property float z\nelement face 2\nproperty list uchar int vertex_index\n"
                 "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 0 1 3\n")
                .triangles,
            3u);
}

TEST_F(ToolReader, ReadsWhatObjFilesHoldBesideTriangles) {
  const std::string text =
      "mtllib not there.mtl\ng part one\nv 9 9 9\nv 0 0 0 1.0\nv +1 0 0 0.5 0.5 0.5\nvt 0 0\n"
      "vn 0 0 1\nusemtl steel\ns off\nv 0 1 0\nv 0 0 1\nf -4/1/1 -2/1/1 \\\n -3/1/1\n"
      "f 2//1 3//1 5//1 # a comment\nf 2/1 5/1 4/1\nf 3 4 5\nl 1 2\n\x1a";
  expect_tetrahedron("a.obj", with_line_ends(text, "\r\n").insert(0, "# head\r\n"));
}

TEST_F(ToolReader, ReadsObjFacesBeforeTheirVertices) {
  expect_tetrahedron("a.obj",
                     "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n");
}

// OpenMesh reads "outer" anywhere in a line as the beginning of a triangle.
TEST_F(ToolReader, ReadsStlWhateverItsSolidsAreCalled) {
  std::string text = ascii_stl(mesh_);
  text.replace(0, text.find('\n'), "solid outer facet normal of my OUTER tool");
  expect_tetrahedron("a.stl", text);
  expect_tetrahedron("b.stl", "\n  SOLID\n" + text.substr(text.find('\n') + 1));
}

TEST_F(ToolReader, ReadsSeveralSolidsInOneStl) {
  EXPECT_EQ(read("a.stl", ascii_stl(mesh_) + ascii_stl(mesh_)).triangles, 8u);
}

TEST_F(ToolReader, TakesBinaryStlForBinaryThoughItBeginsWithSolid) {
  std::string bytes = binary_stl(mesh_);
  bytes.replace(0, 12, "solid tool  ");
  expect_tetrahedron("a.stl", bytes);
  for (std::size_t i = 0; i < 80; ++i) bytes[i] = bytes[i] == '\0' ? ' ' : bytes[i];
  expect_tetrahedron("b.stl", bytes);
}

TEST_F(ToolReader, PassesOverWhatFollowsTheMesh) {
  expect_tetrahedron("a.stl", binary_stl(mesh_) + "made with care");
  expect_tetrahedron("b.stl", ascii_stl(mesh_) + "made with care\n");
  expect_tetrahedron("c.ply", ascii_ply(mesh_) + "made with care\n");
  expect_tetrahedron("d.ply", binary_ply(mesh_, false) + "made with care");
  expect_tetrahedron("e.off", off_text(mesh_) + "made with care\n");
}

// Properties and elements that OpenMesh would misread: lists beside the faces', lists of vertices,
// counts of a type it does not know, faces before vertices.
TEST_F(ToolReader, ReadsPlyFilesWithMoreThanAMesh) {
  const std::string header =
      "ply\nformat ascii 1.0\nobj_info made up\nelement camera 1\nproperty list uchar float "
      "pose\nelement face 4\nproperty uchar red\nproperty list uint short vertex_indices\nproperty "
      "list uchar float texcoord\nelement vertex 4\nproperty double y\nproperty list short int "
      "links\nproperty double x\nproperty double z\nproperty float nx\nelement edge 1\nproperty "
      "int "
      "vertex1\nend_header\n";
  expect_tetrahedron("a.ply",
                     header +
                         "2 0.5 0.5\n255 3 0 2 1 2 0 0\n0 3 0 1 3 0\n0 3 0 3 2 0\n0 3 1 2 "
                         "3 1 0.25\n0 0 0 0 1\n0 2 7 7 1 0 1\n1 0 0 0 nan\n0 1 3 0 1 1\n7\n");
}

TEST_F(ToolReader, ReadsBinaryPlyFilesWithMoreThanAMesh) {
  for (const bool big : {false, true}) {
    std::string bytes =
        std::string("ply\nformat binary_") + (big ? "big" : "little") +
        "_endian 1.0\nelement vertex 3\nproperty float x\nproperty uchar red\nproperty float y\n"
        "property double z\nelement face 1\nproperty list uchar float texcoord\nproperty list char "
        "ushort vertex_indices\nend_header\n";
    for (const glm::vec3& p : {glm::vec3(1, 2, 3), glm::vec3(2, 2, 3), glm::vec3(1, 4, 3)}) {
      bytes += bytes_of(std::vector<float>{p.x}, big) + '\7' +
               bytes_of(std::vector<float>{p.y}, big) +
               bytes_of(std::vector<double>{double{p.z}}, big);
    }
    bytes += '\2' + bytes_of(std::vector<float>{0.5f, 0.5f}, big) + '\3' +
             bytes_of(std::vector<std::uint16_t>{0, 1, 2}, big);
    const MeshSummary found = read("a.ply", bytes);
    EXPECT_EQ(found.triangles, 1u);
    EXPECT_EQ(found.lo, glm::dvec3(1, 2, 3));
    EXPECT_EQ(found.hi, glm::dvec3(2, 4, 3));
  }
}

TEST_F(ToolReader, ReadsTheKindsOfOff) {
  const std::string body = off_text(mesh_).substr(4);
  expect_tetrahedron("a.off", body);  // the keyword may be absent
  expect_tetrahedron("b.off", "# a comment\nOFF " + body + "\n# another\n");
  expect_tetrahedron("c.off",
                     "COFF\n4 4 6\n0 0 0 255 0 0 255\n\n1 0 0 255 0 0 255 # red\n0 1 0 255 0 0 "
                     "255\n0 0 1 255 0 0 255\n3 0 2 1 0.5 0.5 0.5\n3 0 1 3\n3 0 3 2 7\n3 1 2 3\n");
  expect_tetrahedron(
      "d.off",
      "NOFF\n4 4 6\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n0 0 1 0 0 1\n3 0 2 1\n3 0 "
      "1 3\n3 0 3 2\n3 1 2 3\n");
}

TEST_F(ToolReader, RefusesMeshesWithoutTriangles) {
  const TriangleMesh empty;
  expect_refusal("a.stl", binary_stl(empty), "without triangles");
  expect_refusal("b.stl", ascii_stl(empty), "without triangles");
  expect_refusal("c.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "without triangles");
  expect_refusal("d.ply", ascii_ply({mesh_.positions, {}}), "without triangles");
  expect_refusal("e.off", off_text({mesh_.positions, {}}), "without triangles");
  for (const char* name : {"f.stl", "f.obj", "f.ply", "f.off"}) {
    expect_refusal(name, "", "an empty file");
  }
}

TEST_F(ToolReader, RefusesFilesThatEndEarly) {
  const std::string stl = binary_stl(mesh_);
  expect_refusal("a.stl", stl.substr(0, stl.size() - 1), "284 bytes for 4 triangles");
  expect_refusal("b.stl", stl.substr(0, 134), "truncated");
  expect_refusal("c.stl", stl.substr(0, 60), "60 bytes");
  const std::string ascii = ascii_stl(mesh_);
  expect_refusal("d.stl", ascii.substr(0, ascii.find("endsolid")), "expected facet or endsolid");
  expect_refusal("e.stl", ascii.substr(0, 78), "the file's end");
  const std::string ply = binary_ply(mesh_, false);
  expect_refusal("f.ply", ply.substr(0, ply.size() - 1), "3 of \"face\" (truncated)");
  expect_refusal("g.ply", ply.substr(0, ply.size() - 70), "of \"vertex\" (truncated)");
  expect_refusal("h.ply", ply.substr(0, 60), "end_header");
  const std::string off = off_text(mesh_);
  expect_refusal("i.off", off.substr(0, off.rfind('3', off.size() - 3)), "of 4 faces (truncated)");
}

TEST_F(ToolReader, RefusesAnStlWhoseCountIsTooSmall) {
  std::string stl = binary_stl(mesh_);
  stl[80] = 3;
  expect_refusal("a.stl", stl, "expected 4, for which there are bytes");
}

TEST_F(ToolReader, RefusesVerticesThatAreNoFiniteNumbers) {
  TriangleMesh mesh = mesh_;
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    mesh.positions[2].y = bad;
    expect_refusal("a.stl", binary_stl(mesh), "NaN or infinity in triangle 1");
    expect_refusal("b.stl", ascii_stl(mesh), "expected a finite number");
    expect_refusal("c.obj", obj_text(mesh), "expected a finite number");
    expect_refusal("d.off", off_text(mesh), "expected finite numbers");
    expect_refusal("e.ply", ascii_ply(mesh), "expected a finite number");
    expect_refusal("f.ply", binary_ply(mesh, true), "NaN or infinity in vertex 3");
  }
  expect_refusal("g.obj", "v 0 0 1e39\nv 0 1 0\nv 1 0 0\nf 1 2 3\n", "finite");
  expect_refusal("h.obj", "v 0 0 0x10\nv 0 1 0\nv 1 0 0\nf 1 2 3\n", "finite");
}

TEST_F(ToolReader, RefusesCornersThatDoNotExist) {
  TriangleMesh mesh = mesh_;
  mesh.triangles[1].y = 4;
  expect_refusal("a.obj", obj_text(mesh), "vertex 5 in line 8, expected one of 4");
  expect_refusal("b.off", off_text(mesh), "vertex 4 in triangle 2, expected 0 to 3");
  expect_refusal("c.ply", ascii_ply(mesh), "vertex 4 in triangle 2");
  expect_refusal("d.ply", binary_ply(mesh, false), "vertex 4 in triangle 2");
  mesh.triangles[1].y = std::numeric_limits<glm::uint>::max();
  expect_refusal("e.ply", binary_ply(mesh, true), "vertex -1");
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  expect_refusal("f.obj", points + "f 0 1 2\n", "the number of a vertex");
  expect_refusal("g.obj", points + "f -4 1 2\n", "3 vertices before it");
  expect_refusal("h.obj", points + "f 1 2\n", "at least three corners");
}

TEST_F(ToolReader, RefusesCountsThatNoFileHolds) {
  std::string stl = binary_stl(mesh_);
  stl.replace(80, 4, "\xff\xff\xff\xff");
  expect_refusal("a.stl", stl, "214748364834 bytes for 4294967295 triangles");
  for (const std::string count : {"4000000000", "9000000000000000000"}) {
    for (std::string ply : {ascii_ply(mesh_), binary_ply(mesh_, false)}) {
      ply.replace(ply.find("vertex 4") + 7, 1, count);
      expect_refusal("b.ply", ply, "expected");
    }
    expect_refusal("c.off", "OFF\n" + count + " " + count + " 0\n0 0 0\n", "truncated");
  }
  expect_refusal("d.ply", "ply\nformat ascii 1.0\nelement vertex 9000000000000000000\nend_header\n",
                 "without properties");
  const std::string list =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n0 0 0\n";
  expect_refusal("e.ply", list + "4000000000 0 0 0\n", "a list of 4000000000 entries");
  expect_refusal("f.ply", list + "-1 0 0 0\n", "a list of -1 entries");
}

TEST_F(ToolReader, RefusesOtherKindsOfFiles) {
  expect_refusal("a.nii.gz", "x", "a NIfTI volume, expected a tool mesh");
  expect_refusal("a.nrrd", "x", "an NRRD volume");
  expect_refusal("a.glb", "x", "a .glb shell set");
  expect_refusal("a.step", "x", "the ending \".step\", expected a tool mesh (.stl, .obj, .ply");
  expect_refusal("a", "x", "the ending \"\"");
  expect_refusal("a.stl", "glTF" + std::string(200, '\2'), "a .glb shell set");
  expect_refusal("b.stl", "NRRD0004\ntype: uchar\n", "an NRRD volume");
  expect_refusal("c.obj", std::string(128, '\0') + "DICM", "a DICOM file");
  expect_refusal("d.ply", "\x1f\x8b\x08 packed", "a gzip file");
  expect_refusal("e.stl", ascii_ply(mesh_), "a PLY mesh");
  expect_refusal("f.obj", ascii_stl(mesh_), "\"solid\" in line 1");
  expect_refusal("g.off", "OFF BINARY\n", "a binary OFF");
  expect_refusal("h.ply", "ply\nformat ebcdic 1.0\n", "format ascii");
  expect_error(ErrorCode::BadFile, "a folder", [&] { read_tool(folder_.path()); });
  expect_error(ErrorCode::BadFile, "No such file", [&] { read_tool("no.stl"); });
}

TEST(RealTools, HaveTheTrianglesTheirListSays) {
  struct Known {
    const char* name;
    std::size_t triangles, vertices, open_edges, non_manifold_edges;
  };
  for (const Known& known : std::array<Known, 6>{{
           {"tools/scalpel.stl", 27190, 13597, 0, 6},
           {"tools/needle_BardDuaLok57.stl", 1600, 839, 144, 0},
           {"tools/cautery.stl", 542, 273, 0, 0},
           {"tools/gripper_15deg_collision_ascii.stl", 193, 105, 19, 6},
           {"tools/drill_4mm_body.obj", 12655, 8054, 3579, 0},
           {"tools/pedicle_screw_550x40.ply", 3999, 1992, 2, 21},
       }}) {
    NACRE_TEST_DATA_OR_SKIP(path, known.name);
    const MeshSummary found = summarize(read_tool(path).mesh);
    EXPECT_EQ(found.triangles, known.triangles) << known.name;
    EXPECT_EQ(found.vertices, known.vertices) << known.name;
    EXPECT_EQ(found.open_edges, known.open_edges) << known.name;
    EXPECT_EQ(found.non_manifold_edges, known.non_manifold_edges) << known.name;
  }
}

}  // namespace
}  // namespace nacre
