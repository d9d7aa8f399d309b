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
using IntQuad [[gnu::vector_size(16)]] = std::int32_t;

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

/// All lanes joined by the least or the greatest, four at a time.
template <class Four, class Vector, class Join>
inline auto joined(const Vector& v, const Join& join) {
  Four fours[kLanes / 4];
  __builtin_memcpy(fours, &v, sizeof v);
  Four all = fours[0];
  for (int i = 1; i < kLanes / 4; ++i) all = join(all, fours[i]);
  return join(join(all[0], all[1]), join(all[2], all[3]));
}

inline float least_lane(const Floats& v) {
  return joined<Quad>(v, [](const auto& a, const auto& b) { return least(a, b); });
}

template <class Four, class Vector>
inline auto greatest_lane(const Vector& v) {
  return joined<Four>(v, [](const auto& a, const auto& b) { return greatest(a, b); });
}

/// x * x' + y * y' of each pair.
inline Ints dot(const Shorts& a, const Shorts& b) {
#if NACRE_VECTOR_BYTES == 64
  return bits_as<Ints>(__builtin_ia32_pmaddwd512_mask(a, b, Ints{}, 0xFFFF));
#elif NACRE_VECTOR_BYTES == 32
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
#if NACRE_VECTOR_BYTES == 64
  return __builtin_ia32_cvtd2mask512(v);
#elif NACRE_VECTOR_BYTES == 32
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

/// 0, 1, 2, ...
inline Ints lane_numbers() {
  Ints numbers;
  for (int i = 0; i < kLanes; ++i) numbers[i] = i;
  return numbers;
}

/// The corners of a cluster's triangles, in the order in which the faces drawn are clockwise.
struct CornerArrays {
  const std::uint8_t* first;
  const std::uint8_t* second;
  const std::uint8_t* third;
};

/// Something of the corners of as many triangles as there are lanes.
template <class Vector>
struct Corners {
  Vector a, b, c;
};

/// What a table of vertices has at the corners of the triangles from `t` on.
template <class Vector, class Scalar>
inline Corners<Vector> look_up(const Scalar* vertices, [[maybe_unused]] int count,
                               const CornerArrays& corners, int t) {
  Corners<Vector> found{};
#if NACRE_VECTOR_BYTES == 64
  const auto places = [&](const std::uint8_t* corner) -> Ints {
    using Bytes [[gnu::vector_size(kLanes)]] = char;
    return __builtin_ia32_pmovzxbd512_mask(load<Bytes>(corner + t), Ints{}, 0xFFFF);
  };
  const Ints a = places(corners.first);
  const Ints b = places(corners.second);
  const Ints c = places(corners.third);
  for (int i = 0; i < count; i += 2 * kLanes) {  // in two vectors at once
    const auto lower = load<Vector>(vertices + i);
    const auto upper = load<Vector>(vertices + i + kLanes);
    found.a = a >= i ? __builtin_shuffle(lower, upper, a) : found.a;
    found.b = b >= i ? __builtin_shuffle(lower, upper, b) : found.b;
    found.c = c >= i ? __builtin_shuffle(lower, upper, c) : found.c;
  }
#else
  for (int i = 0; i < kLanes; ++i) {
    found.a[i] = vertices[corners.first[t + i]];
    found.b[i] = vertices[corners.second[t + i]];
    found.c[i] = vertices[corners.third[t + i]];
  }
#endif
  return found;
}

/// Stores some lanes (a bit each) one after the other; may write a whole vector.
inline void store_lanes(std::int32_t* to, const Ints& v, unsigned lanes) {
#if NACRE_VECTOR_BYTES == 64
  store(to, __builtin_ia32_compresssi512_mask(v, Ints{}, static_cast<std::uint16_t>(lanes)));
#else
  for (; lanes != 0; lanes &= lanes - 1) *to++ = v[__builtin_ctz(lanes)];
#endif
}

/// The difference modulo 2^32.
inline Ints minus(const Ints& a, const Ints& b) {
  using Unsigned [[gnu::vector_size(NACRE_VECTOR_BYTES)]] = std::uint32_t;
  return bits_as<Ints>(bits_as<Unsigned>(a) - bits_as<Unsigned>(b));
}

/// Four bytes from each offset. AVX-512's gather is no faster (Zen 5).
inline Ints four_bytes(const std::uint8_t* from, const Ints& offsets) {
  alignas(64) std::int32_t at[kLanes];
  store(at, offsets);
  Ints four;
  for (int i = 0; i < kLanes; ++i) four[i] = load<std::int32_t>(from + at[i]);
  return four;
}

}  // namespace
}  // namespace nacre::NACRE_KERNEL
// NOLINTEND(modernize-avoid-c-arrays)
