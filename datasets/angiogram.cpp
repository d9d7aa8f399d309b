#include "datasets/angiogram.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "core/volume_geometry.h"
#include "datasets/cerebral_arteries.h"
#include "datasets/grid.h"
#include "datasets/head_tissue.h"
#include "datasets/portable_math.h"
#include "datasets/random.h"

namespace nacre {
namespace {

constexpr double kLargestValue = 4095.0;  // twelve bits

/// Beyond this many point spreads from its wall a vessel does not show.
constexpr double kReachSpreads = 3.5;

constexpr std::uint64_t kNoiseSalt = 0x6e6f6973;

/// Coverage on the axis over that of a slab of the same width.
double roundness(double radius, double spread) {
  const double x = radius / (std::numbers::sqrt2 * spread);
  return (1.0 - portable_exp(-x * x)) / portable_erf(x);
}

/// Coverage of a slab from -radius to radius.
double slab_coverage(double distance, double radius, double spread) {
  const double scale = 1.0 / (std::numbers::sqrt2 * spread);
  return 0.5 *
         (portable_erf((radius - distance) * scale) + portable_erf((radius + distance) * scale));
}

/// How bright the blood in a vessel is. Slow blood stays longer under the pulses and is darker: in
/// narrow vessels, and where it turns in the sac.
double blood_brightness(double radius_mm) {
  const double slowed = 800.0 * portable_exp(-radius_mm / 0.9);
  return 1450.0 - slowed - 80.0 * std::max(0.0, radius_mm - 2.5);
}

/// A vessel segment ready to be drawn: what does not change from voxel to voxel.
struct DrawnSegment {
  VesselSegment shape;
  glm::dvec3 axis_mm;
  double inverse_length_squared;  ///< 0 for a point
  double from_roundness;
  double to_roundness;
  double from_brightness;
  double to_brightness;
  glm::dvec3 lo_mm;  ///< box of what it may brighten
  glm::dvec3 hi_mm;
};

DrawnSegment prepared(const VesselSegment& shape, double spread_mm) {
  DrawnSegment drawn{};
  drawn.shape = shape;
  drawn.axis_mm = shape.to_mm - shape.from_mm;
  const double length_squared = glm::dot(drawn.axis_mm, drawn.axis_mm);
  drawn.inverse_length_squared = length_squared > 0.0 ? 1.0 / length_squared : 0.0;
  drawn.from_roundness = roundness(shape.from_radius_mm, spread_mm);
  drawn.to_roundness = roundness(shape.to_radius_mm, spread_mm);
  drawn.from_brightness = blood_brightness(shape.from_radius_mm);
  drawn.to_brightness = blood_brightness(shape.to_radius_mm);
  const double reach_mm =
      std::max(shape.from_radius_mm, shape.to_radius_mm) + kReachSpreads * spread_mm;
  drawn.lo_mm = glm::min(shape.from_mm, shape.to_mm) - reach_mm;
  drawn.hi_mm = glm::max(shape.from_mm, shape.to_mm) + reach_mm;
  return drawn;
}

/// What a segment makes of the tissue's signal at a point.
double with_blood(const DrawnSegment& drawn, const glm::dvec3& p_mm, double tissue,
                  double spread_mm) {
  const glm::dvec3 offset_mm = p_mm - drawn.shape.from_mm;
  const double along =
      std::clamp(glm::dot(offset_mm, drawn.axis_mm) * drawn.inverse_length_squared, 0.0, 1.0);
  const auto at = [&](double from, double to) { return from + along * (to - from); };
  const double radius_mm = at(drawn.shape.from_radius_mm, drawn.shape.to_radius_mm);
  const double distance_mm = glm::length(offset_mm - along * drawn.axis_mm);
  if (distance_mm > radius_mm + kReachSpreads * spread_mm) return tissue;
  const double coverage = at(drawn.from_roundness, drawn.to_roundness) *
                          slab_coverage(distance_mm, radius_mm, spread_mm);
  return tissue + (at(drawn.from_brightness, drawn.to_brightness) - tissue) * coverage;
}

/// The scan: what every slice of it needs.
struct Scan {
  glm::i64vec3 size;
  glm::dvec3 origin_mm;
  glm::dvec3 spacing_mm;
  double spread_mm;
  double noise;
  std::uint64_t seed;
  std::vector<DrawnSegment> segments;
  std::vector<std::vector<std::uint32_t>> segments_of_slice;
};

/// First and one past the last sample of an axis in [lo, hi].
struct SampleRange {
  std::int64_t first;
  std::int64_t end;
};

SampleRange samples_between(const Scan& scan, int axis, double lo_mm, double hi_mm) {
  const auto count = static_cast<double>(scan.size[axis]);
  const double first = std::ceil((lo_mm - scan.origin_mm[axis]) / scan.spacing_mm[axis]);
  const double last = std::floor((hi_mm - scan.origin_mm[axis]) / scan.spacing_mm[axis]);
  return {static_cast<std::int64_t>(std::clamp(first, 0.0, count)),
          static_cast<std::int64_t>(std::clamp(last + 1.0, 0.0, count))};
}

Scan prepare_scan(const AngiogramOptions& options, const glm::dmat4& world_from_voxel) {
  Scan scan{.size = options.size,
            .origin_mm = glm::dvec3(world_from_voxel[3]),
            .spacing_mm = spacing_mm(world_from_voxel),
            .spread_mm = 0.0,
            .noise = options.noise,
            .seed = options.seed,
            .segments = {},
            .segments_of_slice = {}};
  const glm::dvec3& edge = scan.spacing_mm;
  scan.spread_mm = kPointSpreadVoxels * portable_cbrt(edge.x * edge.y * edge.z);
  scan.segments_of_slice.resize(static_cast<std::size_t>(scan.size.z));
  for (const VesselSegment& segment : vessel_segments(make_cerebral_arteries(options.seed))) {
    const DrawnSegment drawn = prepared(segment, scan.spread_mm);
    const SampleRange slices = samples_between(scan, 2, drawn.lo_mm.z, drawn.hi_mm.z);
    for (std::int64_t z = slices.first; z < slices.end; ++z) {
      scan.segments_of_slice[static_cast<std::size_t>(z)].push_back(
          static_cast<std::uint32_t>(scan.segments.size()));
    }
    scan.segments.push_back(drawn);
  }
  return scan;
}

std::size_t sample_in_slice(const Scan& scan, std::int64_t x, std::int64_t y) {
  return static_cast<std::size_t>(x + scan.size.x * y);
}

glm::dvec3 position_mm(const Scan& scan, std::int64_t x, std::int64_t y, std::int64_t z) {
  return scan.origin_mm + glm::dvec3(x, y, z) * scan.spacing_mm;
}

std::vector<double> tissue_slice(const Scan& scan, std::int64_t z) {
  std::vector<double> tissue(static_cast<std::size_t>(scan.size.x * scan.size.y));
  const HeadTissue head(scan.seed);
  for (std::int64_t y = 0; y < scan.size.y; ++y) {
    for (std::int64_t x = 0; x < scan.size.x; ++x) {
      tissue[sample_in_slice(scan, x, y)] = head.signal(position_mm(scan, x, y, z));
    }
  }
  return tissue;
}

/// The brightest of the tissue and the vessels in it, sample by sample.
std::vector<double> drawn_slice(const Scan& scan, std::int64_t z) {
  const std::vector<double> tissue = tissue_slice(scan, z);
  std::vector<double> signal = tissue;
  for (const std::uint32_t segment : scan.segments_of_slice[static_cast<std::size_t>(z)]) {
    const DrawnSegment& drawn = scan.segments[segment];
    const SampleRange rows = samples_between(scan, 1, drawn.lo_mm.y, drawn.hi_mm.y);
    const SampleRange columns = samples_between(scan, 0, drawn.lo_mm.x, drawn.hi_mm.x);
    for (std::int64_t y = rows.first; y < rows.end; ++y) {
      for (std::int64_t x = columns.first; x < columns.end; ++x) {
        const std::size_t i = sample_in_slice(scan, x, y);
        const glm::dvec3 p_mm = position_mm(scan, x, y, z);
        signal[i] = std::max(signal[i], with_blood(drawn, p_mm, tissue[i], scan.spread_mm));
      }
    }
  }
  return signal;
}

/// The scanner's part: gain, noise, and whole numbers.
void receive_slice(const Scan& scan, std::int64_t z, std::span<std::int16_t> received) {
  const std::vector<double> signal = drawn_slice(scan, z);
  const std::uint64_t noise_seed = random_bits(scan.seed, kNoiseSalt);
  const std::uint64_t first = static_cast<std::uint64_t>(z) * received.size();
  for (std::int64_t y = 0; y < scan.size.y; ++y) {
    for (std::int64_t x = 0; x < scan.size.x; ++x) {
      const std::size_t i = sample_in_slice(scan, x, y);
      const double gained = signal[i] * coil_gain(position_mm(scan, x, y, z));
      const double magnitude = rician_magnitude(gained, scan.noise, noise_seed, first + i);
      received[i] = static_cast<std::int16_t>(std::min(magnitude + 0.5, kLargestValue));
    }
  }
}

}  // namespace

double vessel_coverage(double distance, double radius, double spread) {
  return roundness(radius, spread) * slab_coverage(distance, radius, spread);
}

double rician_magnitude(double signal, double sigma, std::uint64_t seed, std::uint64_t counter) {
  if (sigma == 0.0) return std::abs(signal);
  const glm::dvec2 noise = sigma * normal_pair(seed, counter);
  const double in_phase = signal + noise.x;
  return std::sqrt(in_phase * in_phase + noise.y * noise.y);
}

Volume make_angiogram(const AngiogramOptions& options, const ProgressCallback& progress) {
  Volume volume = make_volume(options.size, ScalarType::I16);
  volume.world_from_voxel = centered_grid(options.size, kAngiogramExtentMm);
  ProgressMeter meter(progress, "phantom", static_cast<std::size_t>(options.size.z));
  const Scan scan = prepare_scan(options, volume.world_from_voxel);
  const std::span<std::int16_t> samples = samples_as<std::int16_t>(volume);
  const auto slice_size = static_cast<std::size_t>(options.size.x * options.size.y);
  tbb::parallel_for(std::int64_t{0}, options.size.z, [&](std::int64_t z) {
    receive_slice(scan, z, samples.subspan(static_cast<std::size_t>(z) * slice_size, slice_size));
    meter.advance();
  });
  return volume;
}

}  // namespace nacre
