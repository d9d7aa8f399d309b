// Seconds from a volume in memory to compressed shells at equal error: `build`'s way beside VTK's
// (vtkFlyingEdges3D, vtkQuadricDecimation) with Draco, each on all cores.
//
//   build_at_error SCAN LO HI [LEVELS]
//
// 48 uniform levels unless said otherwise. Ways take turns; seconds on the clock are medians of
// kTurns. PSNR is of maximum projections over a certificate's seven views, 256 x 256, over all
// pixels; VTK's contours are open at the volume's border, so that its error is measured of closed
// ones that its filter has decimated alike. Bytes are those of the compressed meshes, VTK's those
// of the open ones that are timed. Ours leaves out specks, as `build` does; VTK's ways keep them.
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <functional>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "bench/plain_pipeline.h"
#include "bench/vtk_contour.h"
#include "bench/vtk_decimator.h"
#include "extract/marching_cubes.h"
#include "io/shell_writer.h"
#include "io/volume_reader.h"
#include "shells/build.h"
#include "shells/certificate.h"
#include "shells/prune.h"

namespace nacre {
namespace {

constexpr int kTurns = 5;
constexpr std::size_t kLevels = 48;

/// A set and what it takes.
struct Made {
  ShellSet set;
  std::size_t bytes = 0;
};

struct Way {
  std::string name;
  bool is_ours;
  std::function<Made()> make;      ///< what is timed
  std::function<Made()> measured;  ///< what its error is taken of; empty: the same
  std::vector<double> seconds = {};
  std::size_t bytes = 0;
  double psnr_db = 0.0;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

class Comparison {
 public:
  Comparison(const Volume& volume, const EmissionMap& emission, std::size_t levels)
      : volume_(volume),
        emission_(emission),
        levels_(uniform_levels(levels)),
        certifier_(volume, emission, {.size = {256, 256}, .maxima_only = true}) {
    ways_.push_back(
        {"nacre, as contoured, 12 bits", true, [this] { return by_build(0.0, 12); }, {}});
    for (const double tolerance : {0.1, 0.15, 0.3, 0.45}) {
      ways_.push_back({fmt::format("nacre, weighted tolerance {}, 12 bits", tolerance),
                       true,
                       [this, tolerance] { return by_build(tolerance, 12); },
                       {}});
    }
    for (const std::size_t part : {2, 4, 8}) {
      ways_.push_back({fmt::format("VTK, to 1/{}, 12 bits", part), false,
                       [this, part] { return by_vtk_filters(part, 12); },
                       [this, part] { return closed_by_vtk(part, 12); }});
    }
  }

  void run() {
    for (int turn = 0; turn < kTurns; ++turn) {
      for (Way& way : ways_) take_turn(way);
    }
    for (const Way& way : ways_) {
      fmt::print("{:40} {:9} bytes {:6.2f} dB {:7.2f} s\n", way.name, way.bytes, way.psnr_db,
                 median(way.seconds));
    }
    for (const Way& peer : ways_) {
      if (!peer.is_ours) print_ratio(peer);
    }
  }

 private:
  Made by_build(double tolerance, int bits) const {
    BuildOptions options;
    options.levels = levels_;
    options.emission_tolerance = tolerance;
    options.tolerance_weight = ToleranceWeight::Picture;
    options.quantization_bits = bits;
    options.min_component_mm3 = default_speck_mm3(volume_.world_from_voxel);
    Made made{build_shells(volume_, emission_, options).set};
    const int effort = effort_for(tolerance > 0.0);  // as `build`
    std::vector<std::size_t> bytes(made.set.shells.size(), 0);
    tbb::parallel_for(std::size_t{0}, bytes.size(), [&](std::size_t k) {
      if (made.set.shells[k].surface.triangles.empty()) return;
      bytes[k] = compress_shell(TriangleMesh(made.set.shells[k].surface), *made.set.grid, effort)
                     .bytes.size();
    });
    made.bytes = std::reduce(bytes.begin(), bytes.end());
    return made;
  }

  Made by_vtk_filters(std::size_t part, int bits) const {
    const VtkContour contour(volume_);
    std::vector<std::size_t> bytes(levels_.size());
    tbb::parallel_for(std::size_t{0}, levels_.size(), [&](std::size_t k) {
      const double kept = 1.0 / static_cast<double>(part);
      bytes[k] = draco_bytes(contour.decimated(value_of(k), kept), bits);
    });
    return {{}, std::reduce(bytes.begin(), bytes.end())};
  }

  Made closed_by_vtk(std::size_t part, int bits) const {
    std::vector<double> values;
    for (std::size_t k = 0; k < levels_.size(); ++k) values.push_back(value_of(k));
    const std::vector<TriangleMesh> surfaces = extract_surfaces(volume_, values);
    Made made;
    made.set.center_mm = bounding_sphere(volume_.dims, volume_.world_from_voxel).center_mm;
    made.set.shells.resize(levels_.size());
    tbb::parallel_for(std::size_t{0}, levels_.size(), [&](std::size_t k) {
      PlainMesh mesh =
          through_draco(by_vtk(surfaces[k], surfaces[k].triangles.size() / part), bits);
      made.set.shells[k] = {levels_[k].emission, values[k], levels_[k].representative,
                            std::move(mesh.decoded)};
    });
    return made;
  }

  double value_of(std::size_t k) const { return emission_.value_at(levels_[k].emission); }

  void take_turn(Way& way) {
    const auto start = std::chrono::steady_clock::now();
    Made made = way.make();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    way.seconds.push_back(seconds.count());
    if (way.seconds.size() > 1) return;
    way.bytes = made.bytes;
    if (way.measured) made = way.measured();
    certifier_.restart();
    certifier_.add(made.set, std::vector<Shell>(made.set.shells));
    way.psnr_db = certifier_.result().max.psnr_db;
  }

  /// How many times as long a peer takes as the fastest of ours that is as good as it, and as the
  /// fastest of those that are no larger.
  void print_ratio(const Way& peer) const {
    print_ratio(peer, "as good", [](const Way&) { return true; });
    print_ratio(peer, "as good, no larger",
                [&](const Way& way) { return way.bytes <= peer.bytes; });
  }

  template <class IsWanted>
  void print_ratio(const Way& peer, const char* words, IsWanted&& is_wanted) const {
    const Way* best = nullptr;
    for (const Way& way : ways_) {
      if (!way.is_ours || way.psnr_db < peer.psnr_db || !is_wanted(way)) continue;
      if (best == nullptr || median(way.seconds) < median(best->seconds)) best = &way;
    }
    if (best == nullptr) return;
    fmt::print("{}: {:.1f} times as long as {} ({})\n", peer.name,
               median(peer.seconds) / median(best->seconds), best->name, words);
  }

  const Volume& volume_;
  const EmissionMap& emission_;
  std::vector<Level> levels_;
  Certifier certifier_;
  std::vector<Way> ways_;
};

void compare(const std::string& path, double lo, double hi, std::size_t levels) {
  const Volume volume = read_volume(path).volume;
  const EmissionMap emission = EmissionMap::window(lo, hi);
  Comparison(volume, emission, levels).run();
}

}  // namespace
}  // namespace nacre

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "build_at_error: expected SCAN LO HI [LEVELS]\n");
    return 2;
  }
  try {
    const std::size_t levels = argc > 4 ? std::strtoul(argv[4], nullptr, 10) : nacre::kLevels;
    nacre::compare(argv[1], std::strtod(argv[2], nullptr), std::strtod(argv[3], nullptr), levels);
  } catch (const std::exception& error) {
    fmt::print(stderr, "build_at_error: {}\n", error.what());
    return 3;
  }
}
