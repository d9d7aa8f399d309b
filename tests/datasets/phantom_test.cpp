#include "datasets/phantom.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "core/error.h"
#include "datasets/closed_forms.h"

namespace nacre {
namespace {

bool same_bytes(const Volume& a, const Volume& b) {
  return a.dims == b.dims && a.world_from_voxel == b.world_from_voxel &&
         a.samples.size() == b.samples.size() &&
         std::memcmp(a.samples.data(), b.samples.data(), a.samples.size()) == 0;
}

/// A size at which a phantom is made quickly.
std::optional<glm::i64vec3> small_size(const PhantomInfo& info) {
  if (info.name == "cell") return std::nullopt;
  return glm::i64vec3(24, 20, 12);
}

/// FNV-1a over the samples' bytes.
std::uint64_t checksum(const Volume& volume) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (std::size_t i = 0; i < volume.samples.size(); ++i) {
    hash = (hash ^ static_cast<std::uint64_t>(volume.samples.data()[i])) * 0x100000001b3;
  }
  return hash;
}

/// The message of the refusal that an order meets.
std::string refusal(std::string_view name, const PhantomOptions& options) {
  try {
    make_phantom(name, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadArgument);
    return error.what();
  }
  ADD_FAILURE() << name << " was not refused";
  return "";
}

TEST(Phantom, EachIsAsItsCardSays) {
  for (const PhantomInfo& info : phantom_list()) {
    if (info.name == "angiogram") continue;  // at full size too slow for a test
    const Volume volume = make_phantom(info.name);
    EXPECT_EQ(volume.dims, info.default_size) << info.name;
    EXPECT_EQ(volume.type, info.type) << info.name;
    EXPECT_LT(info.window_lo, info.window_hi);
  }
}

TEST(Phantom, SameBytesWithOneThreadAndWithTwo) {
  for (const PhantomInfo& info : phantom_list()) {
    const PhantomOptions options{.size = small_size(info), .noise = 1.5};
    const auto made_with = [&](std::size_t threads) {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
      return make_phantom(info.name, options);
    };
    EXPECT_TRUE(same_bytes(made_with(1), made_with(2))) << info.name;
  }
}

// Stored: the bytes may not depend on the compiler, its settings or the machine.
TEST(Phantom, SameBytesOnEveryMachine) {
  EXPECT_EQ(checksum(make_phantom("angiogram", {.size = glm::i64vec3(48, 48, 24)})),
            18040450905837359102u);
  EXPECT_EQ(checksum(make_phantom("torus", {.noise = 0.5})), 12682906184982810935u);
  EXPECT_EQ(checksum(make_phantom("hipip")), 14369651114221521901u);
  EXPECT_EQ(checksum(make_phantom("plume")), 13800113759543183693u);
}

TEST(Phantom, TheSeedChangesWhatIsRandom) {
  for (const std::string_view name : {"angiogram", "cell"}) {
    PhantomOptions options;
    if (name == "angiogram") options = {.size = glm::i64vec3(32, 32, 16), .noise = 0.0};
    const Volume first = make_phantom(name, options);
    options.seed = 2;
    EXPECT_FALSE(same_bytes(first, make_phantom(name, options))) << name;
  }
  EXPECT_FALSE(same_bytes(make_phantom("spheres", {.seed = 1, .noise = 1.0}),
                          make_phantom("spheres", {.seed = 2, .noise = 1.0})));
}

template <class Sample, class Field>
void expect_samples(const Volume& volume, const Field& field, double tolerance) {
  const auto samples = samples_as<Sample>(volume);
  std::size_t i = 0;
  for (std::int64_t z = 0; z < volume.dims.z; ++z) {
    for (std::int64_t y = 0; y < volume.dims.y; ++y) {
      for (std::int64_t x = 0; x < volume.dims.x; ++x, ++i) {
        const glm::dvec3 p_mm(volume.world_from_voxel * glm::dvec4(x, y, z, 1.0));
        ASSERT_NEAR(samples[i], field.value(p_mm), tolerance) << x << ", " << y << ", " << z;
      }
    }
  }
}

TEST(Phantom, ClosedFormsHoldAtTheirSamples) {
  const PhantomOptions odd{.size = glm::i64vec3(17, 30, 9)};
  constexpr double float_rounding = 4e-6;  // half a unit in the last place of values up to 64
  expect_samples<float>(make_phantom("spheres"), SphereField{}, float_rounding);
  expect_samples<float>(make_phantom("spheres", odd), SphereField{}, float_rounding);
  expect_samples<float>(make_phantom("torus", odd), TorusField{}, float_rounding);
  expect_samples<double>(make_phantom("quadratic", odd), QuadraticField{}, 1e-11);
}

TEST(Phantom, CheckerboardAlternates) {
  const Volume volume = make_phantom("checkerboard", {.size = glm::i64vec3(3, 3, 2)});
  const std::vector<float> expected{0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1};
  EXPECT_TRUE(std::ranges::equal(samples_as<float>(volume), expected));
}

TEST(Phantom, CellHasTheGivenCorners) {
  const std::array<double, 8> corners{0.1, -2, 3, 4.75, -5e-300, 6e300, 7, 1.0 / 3.0};
  const Volume volume = make_phantom("cell", {.corners = corners});
  EXPECT_TRUE(std::ranges::equal(samples_as<double>(volume), corners));
  EXPECT_EQ(glm::dvec3(volume.world_from_voxel * glm::dvec4(1, 1, 1, 1)), glm::dvec3(0.5));
}

TEST(Phantom, NoiseHasTheGivenDeviation) {
  const Volume clean = make_phantom("quadratic");
  const Volume noisy = make_phantom("quadratic", {.noise = 3.0});
  const auto a = samples_as<double>(clean);
  const auto b = samples_as<double>(noisy);
  double square = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) square += (b[i] - a[i]) * (b[i] - a[i]);
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(a.size())), 3.0, 0.03);
}

TEST(Phantom, TellsItsProgress) {
  double last = -1.0;
  make_phantom("spheres", {}, [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "phantom");
    EXPECT_GE(fraction, last);
    last = fraction;
  });
  EXPECT_EQ(last, 1.0);
}

TEST(Phantom, AnUnknownNameIsRefusedWithTheKnownOnes) {
  const std::string message = refusal("angiogramm", {});
  EXPECT_NE(message.find("\"angiogramm\""), std::string::npos);
  for (const PhantomInfo& info : phantom_list()) {
    EXPECT_NE(message.find(info.name), std::string::npos) << info.name;
  }
}

TEST(Phantom, WrongOptionsAreRefused) {
  const double infinity = std::numeric_limits<double>::infinity();
  refusal("spheres", {.size = glm::i64vec3(0, 4, 4)});
  refusal("angiogram", {.size = glm::i64vec3(4, -4, 4)});
  refusal("cell", {.size = glm::i64vec3(3, 2, 2)});
  refusal("torus", {.noise = -1.0});
  refusal("torus", {.noise = infinity});
  refusal("torus", {.noise = std::nan("")});
  refusal("torus", {.corners = std::array<double, 8>{}});
  refusal("cell", {.corners = std::array<double, 8>{0, 0, 0, infinity, 0, 0, 0, 0}});
}

}  // namespace
}  // namespace nacre
