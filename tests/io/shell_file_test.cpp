#include <draco/core/quantization_utils.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.h"
#include "core/quantization_grid.h"
#include "io/shell_reader.h"
#include "io/shell_writer.h"
#include "tests/io/small_shell_set.h"
#include "tests/support/analytic_surfaces.h"

namespace nacre {
namespace {

using testing::cube_surface;
using testing::on_grid;
using testing::small_shell_set;
using testing::sphere_surface;

constexpr const char* kName = "set.glb";

ShellSet there_and_back(const ShellSet& set) {
  return decode_shell_set(encode_shell_set(set), kName);
}

using Corner = std::array<float, 3>;

std::size_t json_size(const std::vector<std::byte>& file) {
  std::uint32_t size = 0;
  std::memcpy(&size, file.data() + 12, sizeof(size));
  return size;
}

/// A mesh's triangles by position, each beginning with its least corner: what is left of a mesh
/// when the order of vertices and triangles is left out.
std::multiset<std::array<Corner, 3>> triangles_by_position(const TriangleMesh& mesh) {
  std::multiset<std::array<Corner, 3>> triangles;
  for (const glm::uvec3& t : mesh.triangles) {
    std::array<Corner, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::vec3& p = mesh.positions[t[static_cast<int>(i)]];
      corners[i] = {p.x, p.y, p.z};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    triangles.insert(corners);
  }
  return triangles;
}

TEST(ShellFile, KeepsEveryTriangleBitForBit) {
  const ShellSet set = small_shell_set();
  const ShellSet back = there_and_back(set);
  ASSERT_EQ(back.shells.size(), set.shells.size());
  for (std::size_t k = 0; k < set.shells.size(); ++k) {
    EXPECT_EQ(triangles_by_position(back.shells[k].surface),
              triangles_by_position(set.shells[k].surface))
        << "shell " << k;
  }
}

TEST(ShellFile, KeepsTheDescriptionExactly) {
  const ShellSet set = small_shell_set();
  const ShellSet back = there_and_back(set);
  for (std::size_t k = 0; k < set.shells.size(); ++k) {
    EXPECT_EQ(back.shells[k].emission, set.shells[k].emission);
    EXPECT_EQ(back.shells[k].value, set.shells[k].value);
    EXPECT_EQ(back.shells[k].representative, set.shells[k].representative);
  }
  EXPECT_EQ(back.center_mm, set.center_mm);
  EXPECT_EQ(back.volume.dims, set.volume.dims);
  EXPECT_EQ(back.volume.world_from_voxel, set.volume.world_from_voxel);
  EXPECT_EQ(back.volume.type, set.volume.type);
  EXPECT_EQ(back.volume.slope, set.volume.slope);
  EXPECT_EQ(back.volume.intercept, set.volume.intercept);
  EXPECT_EQ(back.volume.checksum, set.volume.checksum);
  ASSERT_EQ(back.emission.size(), set.emission.size());
  for (std::size_t i = 0; i < set.emission.size(); ++i) {
    EXPECT_EQ(back.emission[i].value, set.emission[i].value);
    EXPECT_EQ(back.emission[i].emission, set.emission[i].emission);
  }
  EXPECT_EQ(back.placement, set.placement);
  EXPECT_EQ(back.tolerance, set.tolerance);
  EXPECT_EQ(back.tolerance_weight, set.tolerance_weight);
  ASSERT_TRUE(back.grid);
  EXPECT_EQ(back.grid->bits, set.grid->bits);
  EXPECT_EQ(back.grid->origin_mm, set.grid->origin_mm);
  EXPECT_EQ(back.grid->range_mm, set.grid->range_mm);
}

// Draco may reorder a mesh once more, but not move it.
TEST(ShellFile, IsAFixedPoint) {
  const ShellSet once = there_and_back(small_shell_set());
  const ShellSet twice = there_and_back(once);
  for (std::size_t k = 0; k < once.shells.size(); ++k) {
    EXPECT_EQ(triangles_by_position(twice.shells[k].surface),
              triangles_by_position(once.shells[k].surface));
  }
}

/// Draco's own arithmetic, on every index of an exact grid or on a million of them.
void expect_fixed_point_of_draco(const QuantizationGrid& grid) {
  ASSERT_TRUE(is_exact(grid));
  const int last = (1 << grid.bits) - 1;
  draco::Quantizer quantizer;
  draco::Dequantizer dequantizer;
  quantizer.Init(static_cast<float>(grid.range_mm), last);
  ASSERT_TRUE(dequantizer.Init(static_cast<float>(grid.range_mm), last));
  const auto origin = static_cast<float>(grid.origin_mm.x);
  for (int i = 0; i <= last; i += 1 + last / 1'000'000) {
    const float position = grid_position(grid, {i, 0, 0}).x;
    const float decoded = dequantizer.DequantizeFloat(i) + origin;
    ASSERT_EQ(decoded, position) << "index " << i << " of " << grid.bits << " bits";
    ASSERT_EQ(quantizer.QuantizeFloat(position - origin), i) << grid.bits << " bits";
  }
}

TEST(ShellFile, ExactGridsAreFixedPointsOfDracosArithmetic) {
  for (int bits = kMinGridBits; bits <= kMaxGridBits; ++bits) {
    for (const double odd : {1.0, 3.0, 1021.0, 4093.0}) {
      const double step = std::ldexp(odd, -12);
      const double count = std::ldexp(1.0, bits);
      const QuantizationGrid grid{glm::dvec3(-step * (std::floor(count / 2.0) + 2.0)),
                                  step * (count - 1.0), bits};
      if (is_exact(grid)) expect_fixed_point_of_draco(grid);
    }
  }
}

/// The small set on a grid of 12 bits with the step odd * 2^exponent, its origin off any whole
/// step.
ShellSet on_fine_grid(double odd, int exponent) {
  const double unit = std::ldexp(1.0, exponent);
  const double step = odd * unit;
  const double last = 4095.0;
  ShellSet set = small_shell_set();
  const double scale = step / step_mm(*set.grid);
  set.grid = {glm::dvec3(-2048.0 * step) + unit * glm::dvec3(0.0, 1.0, -odd / 2.0 + 0.5),
              last * step, 12};
  for (Shell& shell : set.shells) {
    for (glm::vec3& p : shell.surface.positions) p *= scale;
    shell.surface = on_grid(*set.grid, shell.surface);
  }
  return set;
}

// Draco's encoder keeps six decimals of an origin: too few for floats below 16.
TEST(ShellFile, KeepsPositionsOnGridsOfAnyUnitBitForBit) {
  for (const double odd : {1.0, 1021.0, 4093.0}) {
    for (const int exponent : {-90, -40, -24, -20, -15, -9, 0, 20, 60}) {
      const ShellSet set = on_fine_grid(odd, exponent);
      ASSERT_TRUE(is_exact(*set.grid)) << odd << " * 2^" << exponent;
      const ShellSet back = there_and_back(set);
      for (std::size_t k = 0; k < set.shells.size(); ++k) {
        EXPECT_EQ(triangles_by_position(back.shells[k].surface),
                  triangles_by_position(set.shells[k].surface))
            << "shell " << k << ", step " << odd << " * 2^" << exponent;
      }
    }
  }
}

TEST(ShellFile, AGridThatIsNotExactIsRefusedForOneShellToo) {
  const ShellSet set = small_shell_set();
  for (const double range_mm : {0.0, 0.1}) {
    const QuantizationGrid grid{set.grid->origin_mm, range_mm, 12};
    EXPECT_THROW(compress_shell({}, grid), Error);
    EXPECT_THROW(pack_shell({}, grid), Error);
  }
}

TEST(ShellFile, AnEmptyLevelHasNoMesh) {
  const ShellFileInfo info = parse_shell_file_info(encode_shell_set(small_shell_set()), kName);
  EXPECT_GT(info.levels.front().triangles, 0u);
  EXPECT_EQ(info.levels.back().triangles, 0u);
  EXPECT_EQ(info.levels.back().bytes, 0u);
  EXPECT_TRUE(info.set.shells.front().surface.triangles.empty());
}

TEST(ShellFile, ASetWithoutAnySurfaceIsAFileToo) {
  ShellSet set = small_shell_set();
  for (Shell& shell : set.shells) shell.surface = {};
  EXPECT_EQ(there_and_back(set).shells.size(), set.shells.size());
}

TEST(ShellFile, DecodesOnlyWhatIsWanted) {
  ShellReadOptions options;
  options.wanted = [](std::size_t shell) { return shell == 1; };
  const ShellSet back = decode_shell_set(encode_shell_set(small_shell_set()), kName, options);
  EXPECT_TRUE(back.shells[0].surface.triangles.empty());
  EXPECT_FALSE(back.shells[1].surface.triangles.empty());
}

TEST(ShellFile, KeepsCoarseCopiesBesideTheShells) {
  const std::vector<std::byte> file = testing::small_file_with_copies();
  const ShellSet fine = decode_shell_set(file, kName);
  const ShellSet coarse = decode_shell_set(file, kName, {.coarse = true});
  // The third shell has no copy: what there is of it is its own surface.
  ShellSet expected = testing::small_coarse_set();
  expected.shells[2].surface = small_shell_set().shells[2].surface;
  for (std::size_t k = 0; k < fine.shells.size(); ++k) {
    EXPECT_EQ(triangles_by_position(fine.shells[k].surface),
              triangles_by_position(small_shell_set().shells[k].surface));
    EXPECT_EQ(triangles_by_position(coarse.shells[k].surface),
              triangles_by_position(expected.shells[k].surface));
  }
}

TEST(ShellFile, SaysWhatItsCoarseCopiesAre) {
  const ShellFileInfo info = parse_shell_file_info(testing::small_file_with_copies(), kName);
  ASSERT_TRUE(info.coarse.has_value());
  EXPECT_EQ(info.coarse->tolerance, 0.1);
  EXPECT_EQ(info.coarse->max_error_json, R"({"psnr_db":40.5})");
  EXPECT_EQ(info.coarse->max_fine_error_json, R"({"psnr_db":41.5})");
  EXPECT_EQ(info.coarse->sum_error_json, R"({"psnr_db":50.5})");
  ASSERT_EQ(info.coarse->levels.size(), 4u);
  ASSERT_TRUE(info.coarse->levels[0].has_value());
  EXPECT_EQ(info.coarse->levels[0]->triangles,
            testing::small_coarse_set().shells[0].surface.triangles.size());
  EXPECT_GT(info.coarse->levels[0]->bytes, 0u);
  EXPECT_FALSE(info.coarse->levels[2].has_value());
  EXPECT_FALSE(info.coarse->levels[3].has_value());
  EXPECT_FALSE(parse_shell_file_info(encode_shell_set(small_shell_set()), kName).coarse);
}

// Node by node, as a viewer goes that knows nothing of extras.nacre.
TEST(ShellFile, NoNodeShowsACoarseCopy) {
  const auto nodes = [](const std::vector<std::byte>& file) {
    const auto* text = reinterpret_cast<const char*>(file.data() + 20);
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(text, text + json_size(file));
    json["nodes"][0].erase("extras");
    return json["nodes"].dump();
  };
  EXPECT_EQ(nodes(testing::small_file_with_copies()), nodes(encode_shell_set(small_shell_set())));
}

TEST(ShellFile, RefusesCopiesOfWhatIsNotThere) {
  ShellWriteOptions options;
  options.coarse.emplace();
  EXPECT_THROW(encode_shell_set(small_shell_set(), options), Error);
  const ShellSet set = small_shell_set();
  options.coarse->shells.resize(set.shells.size());
  EXPECT_NO_THROW(encode_shell_set(set, options));
  options.coarse->shells.back() =
      compress_shell(TriangleMesh(set.shells.front().surface), *set.grid);
  EXPECT_THROW(encode_shell_set(set, options), Error);
}

TEST(ShellFile, APackedShellIsTheSameShellForAPageAlone) {
  ShellSet set = small_shell_set();
  set.shells.resize(1);
  const TriangleMesh& surface = set.shells.front().surface;
  const CompressedShell small = compress_shell(TriangleMesh(surface), *set.grid);
  const CompressedShell packed = pack_shell(TriangleMesh(surface), *set.grid);
  EXPECT_EQ(packed.triangles, small.triangles);
  EXPECT_EQ(packed.vertices, small.vertices);
  EXPECT_EQ(packed.lo, small.lo);
  EXPECT_EQ(packed.hi, small.hi);
  const std::vector<std::byte> file = assemble_shell_set(set, std::vector{packed});
  EXPECT_EQ(parse_shell_file_info(file, kName).levels.front().triangles, small.triangles);
  EXPECT_THROW(decode_shell_set(file, kName), Error);
}

TEST(ShellFile, CarriesACertificate) {
  ShellWriteOptions options;
  options.certificate_json = R"({"psnr_db":45.25,"views":[1,2]})";
  const ShellFileInfo info =
      parse_shell_file_info(encode_shell_set(small_shell_set(), options), kName);
  EXPECT_EQ(info.certificate_json, options.certificate_json);
}

TEST(ShellFile, SameSetSameBytes) {
  EXPECT_EQ(encode_shell_set(small_shell_set()), encode_shell_set(small_shell_set()));
}

TEST(ShellFile, AppearsWholeUnderItsName) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "nacre_shell_file_test";
  std::filesystem::create_directories(folder);
  write_shell_set(folder / kName, small_shell_set());
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++files;
  EXPECT_EQ(files, 1u);
  EXPECT_EQ(read_shell_set(folder / kName).shells.size(), 4u);
  EXPECT_EQ(read_shell_file_info(folder / kName).file_bytes,
            std::filesystem::file_size(folder / kName));
  std::filesystem::remove_all(folder);
}

TEST(ShellFile, SaysWhenItCannotBeWritten) {
  EXPECT_THROW(write_shell_set("/nonexistent/folder/set.glb", small_shell_set()), Error);
}

/// The message that a set is refused with.
std::string refusal(const ShellSet& set, const ShellWriteOptions& options = {}) {
  try {
    encode_shell_set(set, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadArgument);
    return error.what();
  }
  return "accepted";
}

TEST(ShellFile, RefusesToWriteWhatWouldNotComeBack) {
  ShellSet set = small_shell_set();
  set.shells[0].surface.positions[0].x += 1e-3f;
  EXPECT_NE(refusal(set).find("grid"), std::string::npos) << refusal(set);

  set = small_shell_set();
  set.shells[0].surface.positions[0].x = NAN;
  EXPECT_NE(refusal(set).find("grid"), std::string::npos) << refusal(set);

  set = small_shell_set();
  set.shells[0].surface.triangles[0].x = 1'000'000;
  EXPECT_NE(refusal(set).find("indices"), std::string::npos) << refusal(set);

  set = small_shell_set();
  set.grid.reset();
  EXPECT_NE(refusal(set).find("grid"), std::string::npos) << refusal(set);

  set = small_shell_set();
  std::swap(set.shells[0].emission, set.shells[1].emission);
  EXPECT_NE(refusal(set).find("ascending"), std::string::npos) << refusal(set);

  set = small_shell_set();
  set.volume.world_from_voxel[3][0] = INFINITY;
  EXPECT_NE(refusal(set).find("world_from_voxel"), std::string::npos) << refusal(set);

  set = small_shell_set();
  set.emission.clear();
  EXPECT_NE(refusal(set).find("knots"), std::string::npos) << refusal(set);

  ShellWriteOptions options;
  options.certificate_json = "{";
  EXPECT_NE(refusal(small_shell_set(), options).find("certificate"), std::string::npos);
}

// A flat cap is the least that Draco can be given a triangle: the reader's bound must let it pass.
TEST(ShellFile, FlatSurfacesAreWithinTheReadersBounds) {
  ShellSet set = small_shell_set();
  set.shells[0].surface = on_grid(*set.grid, cube_surface(8.0f, 96));
  EXPECT_EQ(there_and_back(set).shells[0].surface.triangles.size(), 12u * 96u * 96u);
}

}  // namespace
}  // namespace nacre
