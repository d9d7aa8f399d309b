// Vectors of NACRE_VECTOR_BYTES bytes and what is done with them. A part of
// `cluster_kernel_body.h`. NOLINTBEGIN(modernize-avoid-c-arrays)
namespace nacre::NACRE_KERNEL {
namespace {

constexpr int kLanes = NACRE_VECTOR_BYTES / 4;
static_assert(kLanePadding % kLanes == 0);

using Floats [[gnu::vector_size(NACRE_VECTOR_BYTES)]] = float;
using Ints [[gnu::vector_size(NACRE_VECTOR_BYTES)]] = std::int32_t;
using Shorts [[gnu::vector_size(NACRE_VECTOR_BYTES)]] = std::int16_t;  // x, y, x, y, ...
using Quad [[gnu::vector_size(16)]] = float;

template <class To, class From>
inline To bits_as(const From& from) {
  return __builtin_bit_cast(To, from);
}

template <class Vector, class Scalar>
inline Vector load(const Scalar* from) {
  Vector vector;
  __builtin_memcpy(&vector, from, sizeof vector);
  return vector;
}

template <class Vector, class Scalar>
inline void store(Scalar* to, const Vector& vector) {
  __builtin_memcpy(to, &vector, sizeof vector);
}

template <class Vector>
inline Vector least(const Vector& a, const Vector& b) {
  return a < b ? a : b;
}

template <class Vector>
inline Vector greatest(const Vector& a, const Vector& b) {
  return a > b ? a : b;
}

/// x * x' + y * y' of each pair.
inline Ints dot(const Shorts& a, const Shorts& b) {
#if NACRE_VECTOR_BYTES == 32
  return bits_as<Ints>(__builtin_ia32_pmaddwd256(a, b));
#elif defined(__SSE2__)
  return bits_as<Ints>(__builtin_ia32_pmaddwd128(a, b));
#else
  const auto x = [](const Shorts& v) { return (bits_as<Ints>(v) << 16) >> 16; };
  const auto y = [](const Shorts& v) { return bits_as<Ints>(v) >> 16; };
  return x(a) * x(b) + y(a) * y(b);
#endif
}

/// One bit a lane: its sign.
inline unsigned sign_bits(const Ints& v) {
#if NACRE_VECTOR_BYTES == 32
  return static_cast<unsigned>(__builtin_ia32_movmskps256(bits_as<Floats>(v)));
#elif defined(__SSE2__)
  return static_cast<unsigned>(__builtin_ia32_movmskps(bits_as<Floats>(v)));
#else
  unsigned bits = 0;
  for (int i = 0; i < kLanes; ++i) bits |= v[i] < 0 ? 1U << i : 0U;
  return bits;
#endif
}

/// The pairs turned by a quarter: dot(a, turned(b)) = a.x * b.y - a.y * b.x.
inline Shorts turned(const Shorts& v) {
  const Ints pairs = bits_as<Ints>(v);
  const Ints high_half = Ints{} + static_cast<std::int32_t>(0xFFFF0000);
  // (y, x), then the second of each pair negated as two's complement: (y, -x).
  const Ints swapped = (pairs << 16) | ((pairs >> 16) & 0xFFFF);
  return (bits_as<Shorts>(swapped ^ high_half)) - bits_as<Shorts>(high_half);
}

inline Shorts gather(const std::int32_t* vertices, const std::uint8_t* corners) {
  Ints pairs;
  for (int i = 0; i < kLanes; ++i) pairs[i] = vertices[corners[i]];
  return bits_as<Shorts>(pairs);
}

}  // namespace
}  // namespace nacre::NACRE_KERNEL
// NOLINTEND(modernize-avoid-c-arrays)
