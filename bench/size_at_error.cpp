// Bytes at equal error: shell sets simplified against the field beside what a plain pipeline makes
// of the same scan (uniform levels, marching cubes, quadric decimation, Draco). No clock decides
// anything here; seconds are printed for orientation.
//
//   size_at_error SCAN LO HI [LEVELS...]
//
// PSNR and largest error are of maximum projections over a certificate's seven views, 512 x 512,
// over all pixels: with flat layers, as any viewer draws a plain set, and estimated between the
// levels, as Nacre draws.
// Bytes are those of the compressed meshes, without what a file says of them.
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "bench/plain_pipeline.h"
#include "extract/marching_cubes.h"
#include "io/shell_writer.h"
#include "io/volume_reader.h"
#include "shells/budget.h"
#include "shells/build.h"
#include "shells/certificate.h"
#include "shells/prune.h"

namespace nacre {
namespace {

constexpr const char* kOurs = "nacre";
constexpr const char* kContours = "contours";  // as marching cubes leaves them

/// One set: what it takes and what it shows.
struct Row {
  std::string method;
  std::string settings;
  std::size_t bytes = 0;
  double flat_db = 0.0;    ///< PSNR with flat layers
  double fine_db = 0.0;    ///< estimated between the levels
  double max_error = 0.0;  ///< of a pixel, likewise
};

/// How the pictures of a set are drawn.
using Drawn = double Row::*;

class Comparison {
 public:
  Comparison(const Volume& volume, const EmissionMap& emission)
      : volume_(volume), emission_(emission), certifier_(volume, emission, {.maxima_only = true}) {}

  void add_ours(const BudgetCandidate& candidate) {
    const auto start = std::chrono::steady_clock::now();
    BuildOptions options;
    options.levels = uniform_levels(candidate.levels);
    options.emission_tolerance = candidate.tolerance;
    options.tolerance_weight = candidate.weight;
    options.quantization_bits = candidate.bits;
    options.min_component_mm3 = default_speck_mm3(volume_.world_from_voxel);
    ShellSet set = build_shells(volume_, emission_, options).set;
    std::vector<std::size_t> bytes(set.shells.size(), 0);
    tbb::parallel_for(std::size_t{0}, bytes.size(), [&](std::size_t k) {
      if (set.shells[k].surface.triangles.empty()) return;
      bytes[k] = compress_shell(TriangleMesh(set.shells[k].surface), *set.grid).bytes.size();
    });
    add(set, bytes, start,
        {kOurs, fmt::format("{} levels, tolerance {:.3g}, {} bits", candidate.levels,
                            candidate.tolerance, candidate.bits)});
  }

  void add_plain(std::size_t levels) {
    std::vector<double> values;
    ShellSet set;
    for (const Level& level : uniform_levels(levels)) {
      values.push_back(emission_.value_at(level.emission));
      set.shells.push_back({level.emission, values.back(), level.representative, {}});
    }
    set.center_mm = bounding_sphere(volume_.dims, volume_.world_from_voxel).center_mm;
    const std::vector<TriangleMesh> surfaces = extract_surfaces(volume_, values);
    add_decimated({kContours, [](const TriangleMesh& mesh, std::size_t) { return mesh; }}, 1,
                  surfaces, set);
    for (const PlainDecimator& decimator : plain_decimators()) {
      for (const std::size_t part : {4, 8, 16}) add_decimated(decimator, part, surfaces, set);
    }
  }

  const std::vector<Row>& rows() const { return rows_; }

 private:
  using Time = std::chrono::steady_clock::time_point;

  void add_decimated(const PlainDecimator& decimator, std::size_t part,
                     const std::vector<TriangleMesh>& surfaces, ShellSet& set) {
    const Time start = std::chrono::steady_clock::now();
    std::vector<TriangleMesh> simplified(surfaces.size());
    tbb::parallel_for(std::size_t{0}, surfaces.size(), [&](std::size_t k) {
      simplified[k] = decimator.simplify(surfaces[k], surfaces[k].triangles.size() / part);
    });
    for (const int bits : {10, 11}) {
      std::vector<std::size_t> bytes(surfaces.size());
      tbb::parallel_for(std::size_t{0}, surfaces.size(), [&](std::size_t k) {
        PlainMesh mesh = through_draco(simplified[k], bits);
        bytes[k] = mesh.bytes;
        set.shells[k].surface = std::move(mesh.decoded);
      });
      add(set, bytes, start,
          {decimator.name,
           fmt::format("{} levels, to 1/{}, {} bits", surfaces.size(), part, bits)});
    }
  }

  void add(const ShellSet& set, const std::vector<std::size_t>& bytes, const Time& start, Row row) {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    certifier_.restart();
    certifier_.add(set, std::vector<Shell>(set.shells));
    for (const std::size_t part : bytes) row.bytes += part;
    const Certificate measured = certifier_.result();
    row.flat_db = measured.max.psnr_db;
    row.fine_db = measured.max_fine.psnr_db;
    row.max_error = measured.max_fine.max_error;
    fmt::print(
        "{:13} {:36} {:9} bytes, flat {:6.2f}, fine {:6.2f} dB, largest error {:.3f} "
        "{:6.1f} s\n",
        row.method, row.settings, row.bytes, row.flat_db, row.fine_db, row.max_error,
        seconds.count());
    std::fflush(stdout);
    rows_.push_back(std::move(row));
  }

  const Volume& volume_;
  const EmissionMap& emission_;
  Certifier certifier_;
  std::vector<Row> rows_;
};

/// The least bytes for a PSNR: between the two best sets around it, along a straight line of PSNR
/// over the logarithm of bytes; 0 where no set is good enough, or all are better.
double bytes_at(double psnr_db, const std::vector<Row>& rows, const std::string& method,
                Drawn drawn) {
  const Row* below = nullptr;
  const Row* above = nullptr;
  for (const Row& row : rows) {
    if (row.method != method) continue;
    if (row.*drawn >= psnr_db && (above == nullptr || row.bytes < above->bytes)) above = &row;
  }
  if (above == nullptr) return 0.0;
  for (const Row& row : rows) {
    if (row.method != method || row.*drawn >= psnr_db || row.bytes >= above->bytes) continue;
    if (below == nullptr || row.*drawn > below->*drawn) below = &row;
  }
  if (below == nullptr) return 0.0;
  const double weight = (psnr_db - below->*drawn) / (above->*drawn - below->*drawn);
  return std::exp((1.0 - weight) * std::log(static_cast<double>(below->bytes)) +
                  weight * std::log(static_cast<double>(above->bytes)));
}

/// @param plain_drawn  how the sets of plain pipelines are drawn; ours are as Nacre draws them
void print_at_equal_error(const std::vector<Row>& rows, const char* title, Drawn ours_drawn,
                          Drawn plain_drawn) {
  fmt::print("\n{}\n| PSNR | {} |", title, kOurs);
  for (const PlainDecimator& plain : plain_decimators()) fmt::print(" {} | part |", plain.name);
  fmt::print("\n");
  for (double psnr_db = 30.0; psnr_db <= 48.0; psnr_db += 2.0) {
    const double ours = bytes_at(psnr_db, rows, kOurs, ours_drawn);
    if (ours == 0.0) continue;
    fmt::print("| {:.0f} dB | {:.0f} kB |", psnr_db, ours / 1e3);
    for (const PlainDecimator& plain : plain_decimators()) {
      const double theirs = bytes_at(psnr_db, rows, plain.name, plain_drawn);
      if (theirs == 0.0) {
        fmt::print(" | |");
      } else {
        fmt::print(" {:.0f} kB | {:.2f} |", theirs / 1e3, ours / theirs);
      }
    }
    fmt::print("\n");
  }
}

void compare(const std::string& path, double lo, double hi, std::vector<std::size_t> levels) {
  const Volume volume = read_volume(path).volume;
  const EmissionMap emission = EmissionMap::window(lo, hi);
  Comparison comparison(volume, emission);
  if (levels.empty()) levels = {6, 8, 12, 16, 24};
  for (const BudgetCandidate& candidate : budget_ladder(volume.dims, volume.world_from_voxel)) {
    if (candidate.levels >= 4 && candidate.levels <= levels.back()) comparison.add_ours(candidate);
  }
  for (const std::size_t count : levels) comparison.add_plain(count);
  const std::vector<Row>& rows = comparison.rows();
  print_at_equal_error(rows, "ours fine, plain sets flat", &Row::fine_db, &Row::flat_db);
  print_at_equal_error(rows, "both fine", &Row::fine_db, &Row::fine_db);
  print_at_equal_error(rows, "both flat", &Row::flat_db, &Row::flat_db);
}

}  // namespace
}  // namespace nacre

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "size_at_error: expected SCAN LO HI [LEVELS...]\n");
    return 2;
  }
  try {
    std::vector<std::size_t> levels;
    for (int i = 4; i < argc; ++i) levels.push_back(std::strtoul(argv[i], nullptr, 10));
    nacre::compare(argv[1], std::strtod(argv[2], nullptr), std::strtod(argv[3], nullptr), levels);
  } catch (const std::exception& error) {
    fmt::print(stderr, "size_at_error: {}\n", error.what());
    return 3;
  }
}
