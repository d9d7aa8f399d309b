#include "shells/certificate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/quantization_grid.h"
#include "reference/exact_picture.h"
#include "reference/exact_walk.h"
#include "reference/shell_picture.h"
#include "shells/build.h"
#include "shells/surface_emission.h"
#include "shells/trilinear_field.h"
#include "tests/support/expect_error.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

using testing::random_volume;
using testing::volume_of;

constexpr double kRounding = 1e-6;  // of pictures in float
constexpr glm::ivec2 kSize{24, 20};

EmissionMap window() { return EmissionMap::window(20, 250); }

ShellSet shells_of(const Volume& volume) {
  BuildOptions options;
  options.levels = uniform_levels(5);
  return build_shells(volume, window(), options).set;
}

/// The mean square of the differences over the pixels, and over the lit ones.
struct Squares {
  double all = 0.0;
  double lit = 0.0;
  double largest = 0.0;
  double brightest = 0.0;
};

/// Pictures of the whole set at once beside the exact ones, in plain loops.
Squares squares(const ShellSet& set, const Volume& volume, const CertificateView& view,
                PictureMode mode) {
  CameraOptions camera;
  camera.size = kSize;
  camera.view = view.view;
  camera.azimuth_rad = view.azimuth_deg * std::numbers::pi / 180.0;
  camera.elevation_rad = view.elevation_deg * std::numbers::pi / 180.0;
  const Camera from = make_camera(camera, bounding_sphere(volume.dims, volume.world_from_voxel));
  const Image shown = shell_picture(set, from, {.mode = mode}).volume;
  const EmissionMap emission = window();
  const ExactWalk walk(volume, emission);
  const Image exact = exact_picture(walk, from, {.mode = mode}).volume;
  Squares sums;
  double lit = 0.0;
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
    const double error =
        static_cast<double>(shown.pixels[i]) - static_cast<double>(exact.pixels[i]);
    sums.all += error * error / static_cast<double>(exact.pixels.size());
    sums.largest = std::max(sums.largest, std::abs(error));
    sums.brightest = std::max(sums.brightest, static_cast<double>(exact.pixels[i]));
    if (!(exact.pixels[i] > 0.0F)) continue;
    sums.lit += error * error;
    lit += 1.0;
  }
  sums.lit /= lit;
  return sums;
}

void expect_error_is(const CertifiedError& error, const Squares& squares, double peak) {
  EXPECT_NEAR(error.rmse, std::sqrt(squares.all), kRounding * peak);
  EXPECT_NEAR(error.rmse_lit, std::sqrt(squares.lit), kRounding * peak);
  EXPECT_NEAR(error.max_error, squares.largest, kRounding * peak);
  EXPECT_NEAR(error.psnr_db, 10.0 * std::log10(peak * peak / squares.all), 1e-3);
  EXPECT_NEAR(error.psnr_lit_db, 10.0 * std::log10(peak * peak / squares.lit), 1e-3);
}

TEST(Certificate, IsTheErrorOfPicturesOfTheWholeSet) {
  const Volume noise = random_volume<std::uint8_t>({7, 6, 5}, 0, 255);
  const ShellSet set = shells_of(noise);
  const Certificate certificate = certify(set, noise, window(), {.size = kSize});
  ASSERT_EQ(certificate.views.size(), 7u);
  double all_max = 0.0;
  double largest_sum = 0.0;
  for (const CertifiedView& view : certificate.views) {
    const Squares max = squares(set, noise, view.view, PictureMode::Max);
    const Squares sum = squares(set, noise, view.view, PictureMode::Sum);
    EXPECT_GT(max.all, 0.0);
    expect_error_is(view.max, max, 1.0);
    expect_error_is(view.sum, sum, sum.brightest);
    all_max += max.all / 7.0;
    largest_sum = std::max(largest_sum, sum.largest);
  }
  EXPECT_NEAR(certificate.max.rmse, std::sqrt(all_max), kRounding);
  EXPECT_NEAR(certificate.sum.max_error, largest_sum, kRounding * certificate.sum.peak);
}

TEST(Certificate, IsTheSameInAnyParts) {
  const Volume noise = random_volume<std::uint8_t>({6, 6, 6}, 0, 255, 8);
  ShellSet set = shells_of(noise);
  for (Shell& shell : set.shells) shell.sum_representative = 0.9 * shell.representative;
  const Certificate whole = certify(set, noise, window(), {.size = kSize});
  const EmissionMap emission = window();
  Certifier certifier(noise, emission, {.size = kSize});
  for (const Shell& shell : set.shells) certifier.add(set, {shell});
  const Certificate parts = certifier.result();
  EXPECT_DOUBLE_EQ(parts.max.rmse, whole.max.rmse);
  EXPECT_NEAR(parts.sum.rmse, whole.sum.rmse, kRounding * whole.sum.peak);
  EXPECT_DOUBLE_EQ(parts.rms_emission_error, whole.rms_emission_error);
}

TEST(Certificate, OfMaximaAloneServesOneSetAfterTheOther) {
  const Volume noise = random_volume<std::uint8_t>({7, 6, 5}, 0, 255);
  const EmissionMap emission = window();
  const ShellSet set = shells_of(noise);
  Certifier certifier(noise, emission, {.size = kSize, .maxima_only = true});
  certifier.add(set, {set.shells.back()});
  certifier.restart();
  certifier.add(set, std::vector<Shell>(set.shells));
  const Certificate maxima = certifier.result();
  EXPECT_DOUBLE_EQ(maxima.max.rmse, certify(set, noise, emission, {.size = kSize}).max.rmse);
  EXPECT_EQ(maxima.sum.rmse, 0.0);
  EXPECT_EQ(maxima.rms_emission_error, 0.0);
}

// The emission of a ball falls linearly: contouring leaves what trilinear cells bend.
TEST(Certificate, StatesTheEmissionErrorOfTheSurfaces) {
  const Volume ball =
      volume_of<float>({16, 16, 16}, [](std::int64_t i, std::int64_t j, std::int64_t k) {
        const double r = glm::distance(glm::dvec3(i, j, k), glm::dvec3(7.3, 7.6, 7.9));
        return std::max(0.0, 255.0 * (1.0 - r / 7.0));
      });
  const ShellSet set = shells_of(ball);
  const Certificate certificate = certify(set, ball, window(), {.size = kSize});
  const TrilinearField field(ball);
  double largest = 0.0;
  double bound = 0.0;
  double squares = 0.0;
  double area = 0.0;
  for (const Shell& shell : set.shells) {
    const SurfaceEmission emission = measure_surface_emission(
        shell.surface, field, window(), shell.emission, 0.0, step_mm(*set.grid));
    largest = std::max(largest, emission.max_error);
    bound = std::max(bound, emission.error_bound(shell.emission));
    squares += emission.rms_error * emission.rms_error * emission.area_mm2;
    area += emission.area_mm2;
  }
  EXPECT_DOUBLE_EQ(certificate.max_emission_error, largest);
  EXPECT_NEAR(certificate.rms_emission_error, std::sqrt(squares / area), 1e-12);
  EXPECT_DOUBLE_EQ(certificate.emission_error_bound, bound);
  EXPECT_LT(certificate.rms_emission_error, certificate.max_emission_error);
  EXPECT_LE(certificate.max_emission_error, certificate.emission_error_bound);
}

// A volume below the window, and no shell: all pictures are black.
TEST(Certificate, OfWhatShowsNothingIsExact) {
  const Volume dark =
      volume_of<float>({4, 4, 4}, [](std::int64_t, std::int64_t, std::int64_t) { return 5.0; });
  const Certificate certificate = certify(shells_of(dark), dark, window(), {.size = kSize});
  EXPECT_EQ(certificate.max.rmse, 0.0);
  EXPECT_TRUE(std::isinf(certificate.max.psnr_db));
  EXPECT_TRUE(std::isinf(certificate.sum.psnr_lit_db));
  EXPECT_EQ(certificate.max_emission_error, 0.0);
}

TEST(Certificate, NeedsAView) {
  const Volume dark =
      volume_of<float>({2, 2, 2}, [](std::int64_t, std::int64_t, std::int64_t) { return 5.0; });
  testing::expect_error(ErrorCode::BadArgument, "view", [&] {
    const EmissionMap emission = window();
    Certifier(dark, emission, {.views = {}});
  });
}

}  // namespace
}  // namespace nacre
