#include "datasets/phantom.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include "core/error.h"
#include "datasets/angiogram.h"
#include "datasets/closed_forms.h"
#include "datasets/grid.h"
#include "datasets/random.h"
#include "datasets/scalar_fields.h"

namespace nacre {
namespace {

constexpr std::uint64_t kNoiseSalt = 0x6e6f6973;

/// All a maker needs: the options with the phantom's own defaults filled in.
struct Order {
  glm::i64vec3 size;
  std::uint64_t seed;
  double noise;
  std::optional<std::array<double, 8>> corners;
};

using Maker = Volume (*)(const Order&, const ProgressCallback&);

/// The nearest value that a sample can hold.
template <class Sample>
Sample stored_as(double value) {
  if constexpr (std::is_integral_v<Sample>) {
    constexpr double lowest = std::numeric_limits<Sample>::lowest();
    constexpr double highest = std::numeric_limits<Sample>::max();
    value = std::clamp(std::floor(value + 0.5), lowest, highest);
  }
  return static_cast<Sample>(value);
}

/// Samples `field(sample's index, position in mm)` over a box about the origin, with Gaussian
/// noise.
template <class Sample, class Field>
Volume sampled(const Order& order, const glm::dvec3& extent_mm, const ProgressCallback& progress,
               const Field& field) {
  Volume volume = make_volume(order.size, scalar_type_of<Sample>());
  volume.world_from_voxel = centered_grid(order.size, extent_mm);
  const std::span<Sample> samples = samples_as<Sample>(volume);
  const std::uint64_t noise_seed = random_bits(order.seed, kNoiseSalt);
  ProgressMeter meter(progress, "phantom", static_cast<std::size_t>(order.size.z));
  tbb::parallel_for(std::int64_t{0}, order.size.z, [&](std::int64_t z) {
    auto i = static_cast<std::size_t>(z * order.size.x * order.size.y);
    for (std::int64_t y = 0; y < order.size.y; ++y) {
      for (std::int64_t x = 0; x < order.size.x; ++x, ++i) {
        const glm::dvec3 p_mm(volume.world_from_voxel * glm::dvec4(x, y, z, 1.0));
        double value = field(glm::i64vec3(x, y, z), p_mm);
        if (order.noise > 0.0) value += order.noise * normal_pair(noise_seed, i).x;
        samples[i] = stored_as<Sample>(value);
      }
    }
    meter.advance();
  });
  return volume;
}

Volume angiogram(const Order& order, const ProgressCallback& progress) {
  return make_angiogram({.size = order.size, .seed = order.seed, .noise = order.noise}, progress);
}

Volume spheres(const Order& order, const ProgressCallback& progress) {
  return sampled<float>(
      order, glm::dvec3(64.0), progress,
      [](const glm::i64vec3&, const glm::dvec3& p_mm) { return SphereField{}.value(p_mm); });
}

Volume torus(const Order& order, const ProgressCallback& progress) {
  return sampled<float>(
      order, {64.0, 64.0, 32.0}, progress,
      [](const glm::i64vec3&, const glm::dvec3& p_mm) { return TorusField{}.value(p_mm); });
}

Volume quadratic(const Order& order, const ProgressCallback& progress) {
  return sampled<double>(
      order, glm::dvec3(64.0), progress,
      [](const glm::i64vec3&, const glm::dvec3& p_mm) { return QuadraticField{}.value(p_mm); });
}

Volume cell(const Order& order, const ProgressCallback& progress) {
  RandomSequence random(order.seed);
  std::array<double, 8> corners{};
  for (double& corner : corners) corner = random.uniform(-1.0, 1.0);
  corners = order.corners.value_or(corners);
  return sampled<double>(
      order, glm::dvec3(2.0), progress, [&](const glm::i64vec3& index, const glm::dvec3&) {
        return corners[static_cast<std::size_t>(index.x + 2 * index.y + 4 * index.z)];
      });
}

Volume checkerboard(const Order& order, const ProgressCallback& progress) {
  return sampled<float>(order, glm::dvec3(order.size), progress,
                        [](const glm::i64vec3& index, const glm::dvec3&) {
                          return static_cast<double>((index.x + index.y + index.z) % 2);
                        });
}

Volume hipip(const Order& order, const ProgressCallback& progress) {
  return sampled<std::int16_t>(
      order, glm::dvec3(64.0), progress,
      [](const glm::i64vec3&, const glm::dvec3& p_mm) { return hipip_value(p_mm); });
}

Volume plume(const Order& order, const ProgressCallback& progress) {
  return sampled<float>(
      order, {210.0, 210.0, 510.0}, progress,
      [](const glm::i64vec3&, const glm::dvec3& p_mm) { return PlumeField{}.value(p_mm); });
}

constexpr std::array<PhantomInfo, 8> kPhantoms{{
    {"angiogram",
     "arteries of a head with an aneurysm, in tissue, with Rician noise (i16)",
     {256, 256, 124},
     ScalarType::I16,
     20.0,
     400.0,
     1400.0},
    {"spheres",
     "nested spheres: max(0, 28 - |p|), p in mm",
     {64, 64, 64},
     ScalarType::F32,
     0.0,
     0.0,
     28.0},
    {"torus",
     "signed distance to a torus of radii 18 and 8 mm, positive inside",
     {64, 64, 32},
     ScalarType::F32,
     0.0,
     -2.0,
     8.0},
    {"quadratic",
     "nested ellipsoids: 1000 - x^2 - 1.5 y^2 - 2.25 z^2, in mm",
     {64, 64, 64},
     ScalarType::F64,
     0.0,
     100.0,
     1000.0},
    {"cell",
     "a single cell with given or random corners",
     {2, 2, 2},
     ScalarType::F64,
     0.0,
     -1.0,
     1.0},
    {"checkerboard",
     "0 and 1 in turn: the highest frequency a grid can hold",
     {32, 32, 32},
     ScalarType::F32,
     0.0,
     0.0,
     1.0},
    {"hipip",
     "a wave function with lobes of both signs, like the iron protein's (i16)",
     {64, 64, 64},
     ScalarType::I16,
     0.0,
     0.0,
     255.0},
    {"plume",
     "a contaminant in flowing ground water, mg/l",
     {21, 21, 51},
     ScalarType::F32,
     0.0,
     0.0,
     100.0},
}};

constexpr std::array<Maker, kPhantoms.size()> kMakers{angiogram, spheres,      torus, quadratic,
                                                      cell,      checkerboard, hipip, plume};

/// Place of a phantom in the list.
std::size_t place_of(std::string_view name) {
  const auto found = std::ranges::find(kPhantoms, name, &PhantomInfo::name);
  if (found != kPhantoms.end()) return static_cast<std::size_t>(found - kPhantoms.begin());
  std::string known;
  for (const PhantomInfo& info : kPhantoms) {
    known += fmt::format("{}{}", known.empty() ? "" : ", ", info.name);
  }
  throw Error(ErrorCode::BadArgument,
              fmt::format("phantom: found \"{}\", expected one of {}", name, known));
}

void check_size(const PhantomInfo& info, const glm::i64vec3& size) {
  if (std::min({size.x, size.y, size.z}) < 1) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("phantom {}: found a size of {} x {} x {}, expected at least 1 along "
                            "each axis",
                            info.name, size.x, size.y, size.z));
  }
  if (info.name == "cell" && size != info.default_size) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("phantom cell: found a size of {} x {} x {}, expected 2 x 2 x 2: it is "
                            "one cell",
                            size.x, size.y, size.z));
  }
}

void check_corners(const PhantomInfo& info, const std::array<double, 8>& corners) {
  if (info.name != "cell") {
    throw Error(
        ErrorCode::BadArgument,
        fmt::format("phantom {}: found corners, expected none: only cell has them", info.name));
  }
  for (const double corner : corners) {
    if (std::isfinite(corner)) continue;
    throw Error(ErrorCode::BadArgument,
                fmt::format("phantom cell: found a corner of {}, expected finite values", corner));
  }
}

Order checked_order(const PhantomInfo& info, const PhantomOptions& options) {
  const Order order{.size = options.size.value_or(info.default_size),
                    .seed = options.seed,
                    .noise = options.noise.value_or(info.default_noise),
                    .corners = options.corners};
  check_size(info, order.size);
  if (!(order.noise >= 0.0) || !std::isfinite(order.noise)) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("phantom {}: found a noise of {}, expected a finite standard deviation "
                            "of at least 0",
                            info.name, order.noise));
  }
  if (order.corners) check_corners(info, *order.corners);
  return order;
}

}  // namespace

std::span<const PhantomInfo> phantom_list() { return kPhantoms; }

Volume make_phantom(std::string_view name, const PhantomOptions& options,
                    const ProgressCallback& progress) {
  const std::size_t place = place_of(name);
  return kMakers[place](checked_order(kPhantoms[place], options), progress);
}

}  // namespace nacre
