// The exact walk on real scans, against an independent march and against what is known of them.
#include <gtest/gtest.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "extract/default_window.h"
#include "io/volume_reader.h"
#include "reference/exact_picture.h"
#include "tests/support/fine_march.h"
#include "tests/support/test_data.h"

namespace nacre {
namespace {

using testing::FineMarch;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kMarchStep = 1.0 / 50.0;  // voxels
#ifdef NDEBUG
constexpr int kSide = 24;         // pixels
constexpr double kEnough = 60.0;  // dB
#else
// Debug builds take a hundred times as long: a few pixels, of which a single one counts for more.
constexpr int kSide = 10;
constexpr double kEnough = 50.0;
#endif

/// NACRE_THOROUGH=1 looks at every named view and at many more pixels (minutes).
bool thorough() { return std::getenv("NACRE_THOROUGH") != nullptr; }

std::vector<CameraOptions> cameras() {
  const int side = thorough() ? 64 : kSide;
  const glm::ivec2 size(side, side);
  std::vector<CameraOptions> options{
      {.size = size, .azimuth_rad = 40 * kDegree, .elevation_rad = 25 * kDegree},
      {.size = size, .view = NamedView::Left, .roll_rad = 0.3, .field_of_view_rad = 40 * kDegree}};
  if (!thorough()) return options;
  for (const NamedView view : {NamedView::Anterior, NamedView::Posterior, NamedView::Left,
                               NamedView::Right, NamedView::Superior, NamedView::Inferior}) {
    options.push_back({.size = size, .view = view});
  }
  options.push_back({.size = size, .azimuth_rad = -100 * kDegree, .elevation_rad = -50 * kDegree});
  return options;
}

Image marched_picture(const FineMarch& march, const Camera& camera, PictureMode mode,
                      const DepthCue& cue) {
  Image image = make_image(camera.size.x, camera.size.y);
  const double reach = 2.0 * camera.sphere.radius_mm;
  FineMarch::Weight weight;
  if (!is_flat(cue)) {
    weight = [&](const glm::dvec3& p_mm) { return beta(cue, depth_z(camera, p_mm)); };
  }
  tbb::parallel_for(0, image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      const Ray ray = picture_ray(camera, x + 0.5, y + 0.5);
      // The sphere's centre is at t = 0 (orthographic), or `distance` from the eye.
      const double center = camera.perspective ? camera.eye_distance_mm : 0.0;
      const double begin = camera.perspective ? std::max(0.0, center - reach) : -reach;
      image.at(x, y) = static_cast<float>(
          mode == PictureMode::Max ? march.max_emission(ray, begin, center + reach, weight)
                                   : march.emission_integral(ray, begin, center + reach, weight));
    }
  });
  return image;
}

double psnr_db(const Image& a, const Image& b) {
  double peak = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    peak = std::max(peak, static_cast<double>(b.pixels[i]));
    squares += std::pow(static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i]), 2);
  }
  return 20.0 * std::log10(peak / std::sqrt(squares / static_cast<double>(a.pixels.size())));
}

struct Shown {
  PictureMode mode;
  DepthCue cue;
};

/// Maximum and sum, without and with a cue; in short runs a camera takes two of them.
std::vector<Shown> pictures(std::size_t camera) {
  const DepthCue none;
  const DepthCue rising{0.8, 0.2, 0.0};
  const DepthCue falling{-0.6, 0.7, 0.1};
  const std::vector<Shown> all{{PictureMode::Max, none},
                               {PictureMode::Sum, rising},
                               {PictureMode::Max, rising},
                               {PictureMode::Sum, none},
                               {PictureMode::Max, falling}};
  if (thorough()) return all;
  return {all[2 * camera % 4], all[2 * camera % 4 + 1]};
}

struct Scan {
  const char* file;
  double lo;  ///< window; 0,0: the default one
  double hi;
};

class RealScan : public ::testing::TestWithParam<Scan> {};

TEST_P(RealScan, AgreesWithAnIndependentMarch) {
  const Scan& scan = GetParam();
  NACRE_TEST_DATA_OR_SKIP(path, std::string("volumes/") + scan.file);
  const Volume volume = read_volume(path).volume;
  const Window window = scan.hi > scan.lo ? Window{scan.lo, scan.hi} : default_window(volume);
  const EmissionMap emission = EmissionMap::window(window.lo, window.hi);
  const ExactWalk walk(volume, emission);
  const FineMarch march(volume, emission, kMarchStep);
  for (std::size_t i = 0; i < cameras().size(); ++i) {
    const CameraOptions options = cameras()[i];
    const Camera camera =
        make_camera(options, bounding_sphere(volume.dims, volume.world_from_voxel));
    for (const auto& [mode, cue] : pictures(i)) {
      const Image exact = exact_picture(walk, camera, {.mode = mode, .cue = cue}).volume;
      const Image marched = marched_picture(march, camera, mode, cue);
      const double psnr = psnr_db(marched, exact);
      if (thorough())
        std::printf("%-28s %-10s %6.1f dB mode %d cue %g\n", scan.file, name(options.view).data(),
                    psnr, static_cast<int>(mode), cue.a);
      EXPECT_GE(psnr, kEnough) << name(options.view) << " azimuth " << options.azimuth_rad
                               << " mode " << static_cast<int>(mode) << " cue " << cue.a;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shared, RealScan,
    ::testing::Values(Scan{"chris_MRA.nii.gz", 20, 230}, Scan{"MR_Gd.nii.gz", 648, 1556},
                      Scan{"aneurism_256_uint8.nrrd", 20, 250}, Scan{"aorta.mha", 0, 0},
                      Scan{"avf_float_32.nrrd", 0, 0}, Scan{"avf_float_32.nii.gz", 0, 0},
                      Scan{"carotid_76x49x45_float32.mhd", 0, 0},
                      Scan{"hipip_neg_64_uint8.mhd", 0, 255},
                      Scan{"hipip_signed_64_int16.mhd", 0, 255},
                      Scan{"headsq_64x64x93_int16.nhdr", 0, 0}, Scan{"brain1_image.nrrd", 0, 0},
                      Scan{"tooth.nhdr", 0, 0}, Scan{"HeadMRVolume.mhd", 0, 0},
                      Scan{"dicom_brain_pd", 0, 0}),
    [](const auto& scan) {
      std::string label = scan.param.file;
      for (char& c : label) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
      }
      return label;
    });

TEST(RealVolumes, NrrdAndNiftiOfOneScanGiveOnePicture) {
  NACRE_TEST_DATA_OR_SKIP(nrrd, "volumes/avf_float_32.nrrd");
  NACRE_TEST_DATA_OR_SKIP(nifti, "volumes/avf_float_32.nii.gz");
  const EmissionMap emission = EmissionMap::window(500.0, 2300.0);
  const auto picture = [&](const std::filesystem::path& path) {
    const Volume volume = read_volume(path).volume;
    return exact_picture(ExactWalk(volume, emission),
                         make_camera({.size = {64, 64}, .azimuth_rad = 0.5},
                                     bounding_sphere(volume.dims, volume.world_from_voxel)))
        .volume;
  };
  // NIfTI states its geometry in float: seven digits.
  const Image a = picture(nrrd);
  const Image b = picture(nifti);
  for (std::size_t i = 0; i < a.pixels.size(); ++i) EXPECT_NEAR(a.pixels[i], b.pixels[i], 1e-4);
}

/// The triangles of a binary STL: its own few lines, so that the test needs no mesh library.
std::vector<std::array<glm::dvec3, 3>> read_binary_stl(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(80);
  std::uint32_t count = 0;
  file.read(reinterpret_cast<char*>(&count), sizeof count);
  std::vector<std::array<glm::dvec3, 3>> triangles(count);
  for (auto& triangle : triangles) {
    std::array<float, 12> numbers{};
    std::uint16_t attribute = 0;
    file.read(reinterpret_cast<char*>(numbers.data()), sizeof numbers);
    file.read(reinterpret_cast<char*>(&attribute), sizeof attribute);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const float* p = &numbers[3 + 3 * corner];
      triangle[corner] = glm::dvec3(p[0], p[1], p[2]);
    }
  }
  return triangles;
}

// The surface was segmented from this volume by other people's software. In the right frame the
// value falls through it from lumen to tissue; mirrored or shifted, it would not.
TEST(RealVolumes, TheAortaSurfaceLiesOnTheAortasWall) {
  NACRE_TEST_DATA_OR_SKIP(scan, "volumes/aorta.mha");
  NACRE_TEST_DATA_OR_SKIP(stl, "volumes/aorta-surface.stl");
  const Volume volume = read_volume(scan).volume;
  const ExactWalk walk(volume, EmissionMap::window(0.0, 2500.0));
  const auto value_at = [&](const glm::dvec3& p_mm) {
    return walk.max_value({p_mm, {0.0, 0.0, 1.0}}, {0.0, 1e-6});
  };
  double inside = 0.0;
  double wall = 0.0;
  double outside = 0.0;
  std::size_t falling = 0;
  std::size_t seen = 0;
  for (const auto& triangle : read_binary_stl(stl)) {
    const auto lps = [&](std::size_t corner) { return triangle[corner] * glm::dvec3(-1, -1, 1); };
    const glm::dvec3 center = (lps(0) + lps(1) + lps(2)) / 3.0;
    // The stored winding encloses a negative volume: this normal points into the lumen.
    const glm::dvec3 inward = glm::normalize(glm::cross(lps(1) - lps(0), lps(2) - lps(0)));
    const double in = value_at(center + 2.0 * inward);
    const double on = value_at(center);
    const double out = value_at(center - 2.0 * inward);
    if (std::isnan(in) || std::isnan(on) || std::isnan(out)) continue;
    ++seen;
    if (in > out) ++falling;
    inside += in;
    wall += on;
    outside += out;
  }
  const auto count = static_cast<double>(seen);
  EXPECT_GT(seen, 12000u);
  EXPECT_GT(static_cast<double>(falling) / count, 0.95);
  EXPECT_GT(inside / count, 1.3 * wall / count);
  EXPECT_GT(wall / count, 1.3 * outside / count);
}

}  // namespace
}  // namespace nacre
