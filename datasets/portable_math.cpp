#include "datasets/portable_math.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace nacre {
namespace {

constexpr int kMantissaBits = 52;
constexpr int kExponentBias = 1023;

/// 2^n. @param n  in [-1022, 1023]
double power_of_two(int n) {
  const auto exponent = static_cast<std::uint64_t>(std::int64_t{n} + kExponentBias);
  return std::bit_cast<double>(exponent << kMantissaBits);
}

/// Horner's rule, highest power first.
template <std::size_t N>
double polynomial(const std::array<double, N>& coefficients, double x) {
  double sum = coefficients[0];
  for (std::size_t i = 1; i < N; ++i) sum = sum * x + coefficients[i];
  return sum;
}

}  // namespace

double portable_log(double x) {
  // x = m * 2^e with m in [1/sqrt(2), sqrt(2)); log m = 2 atanh s, s = (m - 1) / (m + 1).
  const auto bits = std::bit_cast<std::uint64_t>(x);
  int e = static_cast<int>(bits >> kMantissaBits) - kExponentBias;
  double m = x / power_of_two(e);
  if (m > std::numbers::sqrt2) {
    m *= 0.5;
    ++e;
  }
  const double s = (m - 1.0) / (m + 1.0);
  constexpr std::array atanh_series{1.0 / 21, 1.0 / 19, 1.0 / 17, 1.0 / 15, 1.0 / 13, 1.0 / 11,
                                    1.0 / 9,  1.0 / 7,  1.0 / 5,  1.0 / 3,  1.0};
  return 2.0 * s * polynomial(atanh_series, s * s) + e * std::numbers::ln2;
}

double portable_exp(double x) {
  if (x < -700.0) return 0.0;
  // ln 2 in two parts: the product of the first with a small integer is exact.
  constexpr double ln2_high = 0x1.62e42fee00000p-1;
  constexpr double ln2_low = 0x1.a39ef35793c76p-33;
  const double n = std::floor(x / std::numbers::ln2 + 0.5);
  const double r = (x - n * ln2_high) - n * ln2_low;
  constexpr std::array exp_series{1.0 / 6227020800,
                                  1.0 / 479001600,
                                  1.0 / 39916800,
                                  1.0 / 3628800,
                                  1.0 / 362880,
                                  1.0 / 40320,
                                  1.0 / 5040,
                                  1.0 / 720,
                                  1.0 / 120,
                                  1.0 / 24,
                                  1.0 / 6,
                                  1.0 / 2,
                                  1.0,
                                  1.0};
  return polynomial(exp_series, r) * power_of_two(static_cast<int>(n));
}

double portable_cbrt(double x) {
  if (x == 0.0) return 0.0;
  // A third of the exponent is a guess within 6 %; Newton's steps square the error.
  const std::uint64_t guess =
      std::bit_cast<std::uint64_t>(x) / 3 + (std::uint64_t{0x2a9f7893} << 32);
  auto root = std::bit_cast<double>(guess);
  for (int step = 0; step < 5; ++step) root = (2.0 * root + x / (root * root)) / 3.0;
  return root;
}

double portable_erfc(double x) {
  const double magnitude = std::abs(x);
  const double t = 1.0 / (1.0 + 0.3275911 * magnitude);
  constexpr std::array series{1.061405429, -1.453152027, 1.421413741, -0.284496736, 0.254829592};
  const double tail = t * polynomial(series, t) * portable_exp(-magnitude * magnitude);
  return x < 0.0 ? 2.0 - tail : tail;
}

double portable_erf(double x) { return 1.0 - portable_erfc(x); }

CosSin portable_cos_sin(double u) {
  // The nearest quarter turn, and a rest of at most an eighth of a turn.
  const double quarter = std::floor(4.0 * u + 0.5);
  const double theta = 2.0 * std::numbers::pi * (u - 0.25 * quarter);
  constexpr std::array sine_series{
      -1.0 / 1307674368000, 1.0 / 6227020800, -1.0 / 39916800, 1.0 / 362880,
      -1.0 / 5040,          1.0 / 120,        -1.0 / 6,        1.0};
  constexpr std::array cosine_series{1.0 / 20922789888000,
                                     -1.0 / 87178291200,
                                     1.0 / 479001600,
                                     -1.0 / 3628800,
                                     1.0 / 40320,
                                     -1.0 / 720,
                                     1.0 / 24,
                                     -1.0 / 2,
                                     1.0};
  const double sine = theta * polynomial(sine_series, theta * theta);
  const double cosine = polynomial(cosine_series, theta * theta);
  switch (static_cast<int>(quarter) & 3) {
    case 0: return {cosine, sine};
    case 1: return {-sine, cosine};
    case 2: return {-cosine, -sine};
    default: return {sine, -cosine};
  }
}

}  // namespace nacre
