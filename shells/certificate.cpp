#include "shells/certificate.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.h"
#include "core/image.h"
#include "core/quantization_grid.h"
#include "core/volume_silhouette.h"
#include "reference/exact_picture.h"
#include "reference/exact_walk.h"
#include "reference/shell_picture.h"
#include "shells/surface_emission.h"
#include "shells/trilinear_field.h"

namespace nacre {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
/// Rays a pixel along each axis that maxima are estimated from, as the command draws them.
constexpr int kSamples = 3;

/// Sums over the pixels of pictures beside exact ones.
struct PixelSums {
  double pixels = 0.0;
  double lit = 0.0;
  double squares = 0.0;
  double squares_lit = 0.0;
  double largest = 0.0;
  double brightest = 0.0;  ///< exact pixel

  void add(double shown, double exact) {
    const double error = shown - exact;
    pixels += 1.0;
    squares += error * error;
    largest = std::max(largest, std::abs(error));
    if (!(exact > 0.0)) return;
    lit += 1.0;
    squares_lit += error * error;
    brightest = std::max(brightest, exact);
  }

  void add(const PixelSums& other) {
    pixels += other.pixels;
    lit += other.lit;
    squares += other.squares;
    squares_lit += other.squares_lit;
    largest = std::max(largest, other.largest);
    brightest = std::max(brightest, other.brightest);
  }

  /// @param peak  what PSNR is against
  CertifiedError error(double peak) const {
    const auto root_mean = [](double sum, double count) {
      return count > 0.0 ? std::sqrt(sum / count) : 0.0;
    };
    CertifiedError error;
    error.peak = peak;
    error.rmse = root_mean(squares, pixels);
    error.rmse_lit = root_mean(squares_lit, lit);
    error.psnr_db = 20.0 * std::log10(peak / error.rmse);
    error.psnr_lit_db = 20.0 * std::log10(peak / error.rmse_lit);
    error.max_error = largest;
    return error;
  }

  CertifiedError error_of_max() const { return error(1.0); }
  /// Where nothing is lit any peak will do.
  CertifiedError error_of_sum() const { return error(brightest > 0.0 ? brightest : 1.0); }
};

CameraOptions camera_of(const CertificateView& view, const glm::ivec2& size) {
  CameraOptions options;
  options.size = size;
  options.view = view.view;
  options.azimuth_rad = view.azimuth_deg * kDegree;
  options.elevation_rad = view.elevation_deg * kDegree;
  return options;
}

}  // namespace

/// One view's exact pictures, and what the shells show so far.
class Certifier::Pictures {
 public:
  /// @param maxima_only  the sums' pictures are then without pixels
  /// @param columns  that meet the volume's box
  Pictures(const ExactWalk& walk, const Camera& camera, std::vector<PixelSpan> columns,
           bool maxima_only)
      : camera_(camera),
        columns_(std::move(columns)),
        exact_max_(exact_picture(walk, camera, {.mode = PictureMode::Max}).volume),
        exact_sum_(maxima_only ? Image()
                               : exact_picture(walk, camera, {.mode = PictureMode::Sum}).volume) {
    restart();
  }

  void restart() {
    shown_max_ = make_image(kSamples * camera_.size.x, kSamples * camera_.size.y);
    shown_sum_.assign(exact_sum_.pixels.size(), 0.0);
  }

  void add(const ShellSet& part) {
    const Image max =
        shell_picture(part, with_samples(camera_, kSamples), {.mode = PictureMode::Max}).volume;
    std::ranges::transform(shown_max_.pixels, max.pixels, shown_max_.pixels.begin(),
                           [](float a, float b) { return std::max(a, b); });
    if (shown_sum_.empty()) return;
    const Image sum = shell_picture(part, camera_, {.mode = PictureMode::Sum}).volume;
    for (std::size_t i = 0; i < shown_sum_.size(); ++i) {
      shown_sum_[i] += static_cast<double>(sum.pixels[i]);
    }
  }

  PixelSums max() const { return beside_exact(middle_samples(shown_max_, kSamples)); }

  /// Between these layers; flat where there are none.
  PixelSums max_fine(std::span<const LayerRange> layers) const {
    if (layers.empty()) return max();
    DequantizationMemory memory;
    Image estimate;
    dequantize(shown_max_, kSamples, layers, {}, {}, memory, estimate);
    black_outside(columns_, estimate);
    return beside_exact(estimate);
  }

  PixelSums sum() const {
    PixelSums sums;
    for (std::size_t i = 0; i < exact_sum_.pixels.size(); ++i) {
      sums.add(shown_sum_[i], static_cast<double>(exact_sum_.pixels[i]));
    }
    return sums;
  }

 private:
  PixelSums beside_exact(const Image& shown_max) const {
    PixelSums sums;
    for (std::size_t i = 0; i < exact_max_.pixels.size(); ++i) {
      sums.add(static_cast<double>(shown_max.pixels[i]), static_cast<double>(exact_max_.pixels[i]));
    }
    return sums;
  }

  Camera camera_;
  std::vector<PixelSpan> columns_;
  Image exact_max_;
  Image exact_sum_;
  Image shown_max_;  ///< of all rays
  std::vector<double> shown_sum_;
};

/// What the surfaces are off their levels.
struct Certifier::Emissions {
  explicit Emissions(const Volume& volume) : field(volume) {}

  void add(const Shell& shell, const EmissionMap& map, double grid_step_mm) {
    const SurfaceEmission measured =
        measure_surface_emission(shell.surface, field, map, shell.emission, 0.0, grid_step_mm);
    max_error = std::max(max_error, measured.max_error);
    bound = std::max(bound, measured.error_bound(shell.emission));
    squares += measured.rms_error * measured.rms_error * measured.area_mm2;
    area_mm2 += measured.area_mm2;
  }

  TrilinearField field;
  double max_error = 0.0;
  double bound = 0.0;
  double squares = 0.0;  ///< times area
  double area_mm2 = 0.0;
};

std::vector<CertificateView> certificate_views() {
  std::vector<CertificateView> views = {{}, {.azimuth_deg = 90.0}, {.view = NamedView::Superior}};
  for (const double azimuth_deg : {45.0, 135.0, 225.0, 315.0}) {
    views.push_back({.azimuth_deg = azimuth_deg, .elevation_deg = 35.0});
  }
  return views;
}

Certifier::Certifier(const Volume& volume, const EmissionMap& emission,
                     const CertificateOptions& options)
    : volume_(volume), emission_(emission), options_(options) {
  if (options.views.empty()) {
    throw Error(ErrorCode::BadArgument, "certificate: found no view, expected one or more");
  }
  const BoundingSphere sphere = bounding_sphere(volume.dims, volume.world_from_voxel);
  const ExactWalk walk(volume, emission);
  ProgressMeter progress(options_.progress, "exact pictures", options.views.size());
  for (const CertificateView& view : options.views) {
    const Camera camera = make_camera(camera_of(view, options.size), sphere);
    pictures_.emplace_back(walk, camera,
                           volume_silhouette(camera, volume.dims, volume.world_from_voxel),
                           options.maxima_only);
    progress.advance();
  }
  emissions_ = std::make_unique<Emissions>(volume);
}

Certifier::~Certifier() = default;

void Certifier::add(const ShellSet& set, std::vector<Shell>&& shells) {
  const double grid_step_mm = set.grid ? step_mm(*set.grid) : 0.0;
  if (!options_.maxima_only) {
    for (const Shell& shell : shells) emissions_->add(shell, emission_, grid_step_mm);
  }
  if (shells.empty()) return;
  for (const Shell& shell : shells) levels_.push_back({shell.emission, shell.representative});
  ShellSet part;
  part.center_mm = set.center_mm;
  part.volume = set.volume;
  part.shells = std::move(shells);
  // A part's sums begin at 0, where those of the shells before it end.
  const double summed = sum_representative(part.shells.back());
  for (Shell& shell : part.shells) {
    shell.sum_representative = sum_representative(shell) - summed_below_;
  }
  summed_below_ = summed;
  for (Pictures& pictures : pictures_) pictures.add(part);
}

void Certifier::restart() {
  for (Pictures& pictures : pictures_) pictures.restart();
  emissions_ = std::make_unique<Emissions>(volume_);
  summed_below_ = 0.0;
  levels_.clear();
}

Certificate Certifier::result() const {
  Certificate certificate;
  certificate.size = options_.size;
  PixelSums all_max;
  PixelSums all_sum;
  PixelSums all_smooth;
  const std::vector<LayerRange> layers = layer_ranges(levels_);
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    const PixelSums max = pictures_[i].max();
    const PixelSums sum = pictures_[i].sum();
    all_max.add(max);
    all_sum.add(sum);
    const PixelSums smooth = pictures_[i].max_fine(layers);
    all_smooth.add(smooth);
    certificate.views.push_back(
        {options_.views[i], max.error_of_max(), sum.error_of_sum(), smooth.error_of_max()});
  }
  certificate.max = all_max.error_of_max();
  certificate.sum = all_sum.error_of_sum();
  certificate.max_fine = all_smooth.error_of_max();
  certificate.max_emission_error = emissions_->max_error;
  certificate.emission_error_bound = emissions_->bound;
  if (emissions_->area_mm2 > 0.0) {
    certificate.rms_emission_error = std::sqrt(emissions_->squares / emissions_->area_mm2);
  }
  return certificate;
}

Certificate certify(const ShellSet& set, const Volume& volume, const EmissionMap& emission,
                    const CertificateOptions& options) {
  Certifier certifier(volume, emission, options);
  certifier.add(set, std::vector<Shell>(set.shells));
  return certifier.result();
}

}  // namespace nacre
