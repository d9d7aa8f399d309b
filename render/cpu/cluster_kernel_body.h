// The kernel of `cluster_kernel.h` for vectors of NACRE_VECTOR_BYTES bytes, in the namespace
// NACRE_KERNEL. Included once by each instruction set's source, after all other headers, so that
// nothing but this is compiled for that set. Uses no library function for the same reason.
namespace nacre {
namespace NACRE_KERNEL {
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

/// -1 where a centre exactly on the edge is not covered: on lower and right edges.
inline Ints edge_bias(const Shorts& edge) {
  const Ints pairs = bits_as<Ints>(edge);
  const Ints x = (pairs << 16) >> 16;
  const Ints y = pairs >> 16;
  const Ints covered = (y < 0) | ((y == 0) & (x > 0));
  return ~covered;
}

/// What lanes share while a shell is drawn.
template <class Rank>
struct Kernel {
  const ClusterProjection& projection;
  const RankTarget<Rank>& target;
  float half_width;
  float half_height;
  Quad plane_x, plane_y, plane_z, plane_w;  // left, right, top, bottom: positive inside
};

struct Rows {
  const glm::vec4& x;
  const glm::vec4& y;
  const glm::vec4& w;
};

inline Quad magnitude(const Quad& v) { return v < 0.0F ? -v : v; }

template <class Rank>
Kernel<Rank> make_kernel(const ClusterProjection& projection, const RankTarget<Rank>& target) {
  Kernel<Rank> kernel{projection,
                      target,
                      0.5F * static_cast<float>(target.width),
                      0.5F * static_cast<float>(target.height),
                      {},
                      {},
                      {},
                      {}};
  // A pixel wider than the target, so that rounding cuts nothing away.
  const float wide = 1.0F + 1.0F / kernel.half_width;
  const float high = 1.0F + 1.0F / kernel.half_height;
  const auto planes = [&](float x, float y, float w) {
    return Quad{w * wide + x, w * wide - x, w * high + y, w * high - y};
  };
  const auto& [row_x, row_y, row_w] = Rows{projection.row_x, projection.row_y, projection.row_w};
  kernel.plane_x = planes(row_x.x, row_y.x, row_w.x);
  kernel.plane_y = planes(row_x.y, row_y.y, row_w.y);
  kernel.plane_z = planes(row_x.z, row_y.z, row_w.z);
  kernel.plane_w = planes(row_x.w, row_y.w, row_w.w);
  return kernel;
}

template <class Rank>
bool outside(const Kernel<Rank>& kernel, const Cluster& cluster) {
  const auto& c = cluster.center_mm;
  const auto& e = cluster.extent_mm;
  const Quad most = kernel.plane_x * c.x + kernel.plane_y * c.y + kernel.plane_z * c.z +
                    kernel.plane_w + magnitude(kernel.plane_x) * e.x +
                    magnitude(kernel.plane_y) * e.y + magnitude(kernel.plane_z) * e.z;
  return most[0] < 0.0F || most[1] < 0.0F || most[2] < 0.0F || most[3] < 0.0F;
}

/// Whether all triangles face away from the eye (`sign` 1) or all towards it (-1).
template <class Rank>
bool turned_away(const Kernel<Rank>& kernel, const Cluster& cluster, float sign) {
  if (cluster.cone_sine >= 1.0F) return false;
  const auto& from = kernel.projection.view_from;
  const auto& axis = cluster.cone_axis;
  if (!kernel.projection.perspective) {
    return sign * (from.x * axis.x + from.y * axis.y + from.z * axis.z) > cluster.cone_sine;
  }
  const float x = cluster.center_mm.x - from.x;
  const float y = cluster.center_mm.y - from.y;
  const float z = cluster.center_mm.z - from.z;
  const auto& e = cluster.extent_mm;
  const float distance = __builtin_sqrtf(x * x + y * y + z * z);
  const float radius = __builtin_sqrtf(e.x * e.x + e.y * e.y + e.z * e.z);
  return sign * (x * axis.x + y * axis.y + z * axis.z) > cluster.cone_sine * distance + radius;
}

enum class Reach { Beyond, Crosses, Behind };

template <class Rank>
Reach near_plane(const Kernel<Rank>& kernel, const Cluster& cluster) {
  if (!kernel.projection.perspective) return Reach::Beyond;
  const auto& row = kernel.projection.row_w;
  const auto& c = cluster.center_mm;
  const auto& e = cluster.extent_mm;
  const float middle = row.x * c.x + row.y * c.y + row.z * c.z + row.w;
  const float reach =
      __builtin_fabsf(row.x) * e.x + __builtin_fabsf(row.y) * e.y + __builtin_fabsf(row.z) * e.z;
  if (middle + reach < kernel.projection.near_mm) return Reach::Behind;
  return middle - reach > kernel.projection.near_mm ? Reach::Beyond : Reach::Crosses;
}

struct PixelVertices {
  alignas(64) float x[256];  // pixels
  alignas(64) float y[256];
  alignas(64) std::int32_t xy[256];  // sub-pixels from the origin, x in the lower half
  int origin_x, origin_y;            // a pixel
};

struct Extent {
  float lo, hi;
};

inline Extent extent_of(const Floats& lo, const Floats& hi) {
  Extent extent{lo[0], hi[0]};
  for (int i = 1; i < kLanes; ++i) {
    extent.lo = lo[i] < extent.lo ? lo[i] : extent.lo;
    extent.hi = hi[i] > extent.hi ? hi[i] : extent.hi;
  }
  return extent;
}

inline Floats row_at(const glm::vec4& row, const Floats& x, const Floats& y, const Floats& z) {
  return row.x * x + row.y * y + row.z * z + row.w;
}

/// Projects and rounds. False if the cluster is too large.
template <class Rank>
bool project(const Kernel<Rank>& kernel, const float* positions, int count, PixelVertices& out) {
  const ClusterProjection& projection = kernel.projection;
  Floats lo_x = Floats{} + 1e30F;
  Floats lo_y = lo_x;
  Floats hi_x = -lo_x;
  Floats hi_y = -lo_x;
  for (int i = 0; i < count; i += kLanes) {
    const auto x = load<Floats>(positions + i);
    const auto y = load<Floats>(positions + count + i);
    const auto z = load<Floats>(positions + 2 * count + i);
    Floats clip_x = row_at(projection.row_x, x, y, z);
    Floats clip_y = row_at(projection.row_y, x, y, z);
    if (projection.perspective) {
      const Floats over_w = 1.0F / row_at(projection.row_w, x, y, z);
      clip_x *= over_w;
      clip_y *= over_w;
    }
    const Floats pixel_x = clip_x * kernel.half_width + kernel.half_width;
    const Floats pixel_y = clip_y * kernel.half_height + kernel.half_height;
    lo_x = least(lo_x, pixel_x);
    hi_x = greatest(hi_x, pixel_x);
    lo_y = least(lo_y, pixel_y);
    hi_y = greatest(hi_y, pixel_y);
    store(out.x + i, pixel_x);
    store(out.y + i, pixel_y);
  }
  const Extent across = extent_of(lo_x, hi_x);
  const Extent down = extent_of(lo_y, hi_y);
  if (!(across.hi - across.lo < kKernelSide && down.hi - down.lo < kKernelSide)) return false;
  // Widening by a pixel lets clusters be at most that far outside.
  out.origin_x = static_cast<int>(across.lo + kKernelSide) - static_cast<int>(kKernelSide);
  out.origin_y = static_cast<int>(down.lo + kKernelSide) - static_cast<int>(kKernelSide);
  // Adding 1.5 * 2^23 rounds to the nearest integer and leaves it in the lowest bits. Rounded
  // before the origin is taken off: neighbouring clusters have different origins, but share
  // vertices.
  constexpr float kRound = 12582912.0F;
  constexpr std::int32_t kRoundBits = 0x4B400000;
  const std::int32_t from_x = kRoundBits + out.origin_x * kSubpixels;
  const std::int32_t from_y = kRoundBits + out.origin_y * kSubpixels;
  for (int i = 0; i < count; i += kLanes) {
    const Floats x = load<Floats>(out.x + i) * static_cast<float>(kSubpixels) + kRound;
    const Floats y = load<Floats>(out.y + i) * static_cast<float>(kSubpixels) + kRound;
    const Ints whole_x = bits_as<Ints>(x) - from_x;
    const Ints whole_y = bits_as<Ints>(y) - from_y;
    store(out.xy + i, (whole_x & 0xFFFF) | (whole_y << 16));
  }
  return true;
}

/// A lane's triangle, ready to be covered.
struct LaneTriangles {
  alignas(64) std::int32_t value[3][kLanes];  // edge functions at the first centre, biased
  alignas(64) std::int32_t edge[3][kLanes];   // x in the lower half
  alignas(64) std::int32_t first[kLanes];     // pixel, x in the lower half
  alignas(64) std::int32_t last[kLanes];
};

inline int low(std::int32_t pair) { return static_cast<std::int16_t>(pair & 0xFFFF); }
inline int high(std::int32_t pair) { return pair >> 16; }

template <class Rank>
inline void raise(Rank& pixel, Rank rank) {
  pixel = pixel < rank ? rank : pixel;
}

template <class Rank>
inline void cover(const LaneTriangles& lanes, int i, Rank* origin, int stride, Rank rank) {
  const int first_x = low(lanes.first[i]);
  const int last_x = low(lanes.last[i]);
  const int last_y = high(lanes.last[i]);
  std::int32_t row0 = lanes.value[0][i];
  std::int32_t row1 = lanes.value[1][i];
  std::int32_t row2 = lanes.value[2][i];
  const std::int32_t x0 = -high(lanes.edge[0][i]) * kSubpixels;
  const std::int32_t x1 = -high(lanes.edge[1][i]) * kSubpixels;
  const std::int32_t x2 = -high(lanes.edge[2][i]) * kSubpixels;
  const std::int32_t y0 = low(lanes.edge[0][i]) * kSubpixels;
  const std::int32_t y1 = low(lanes.edge[1][i]) * kSubpixels;
  const std::int32_t y2 = low(lanes.edge[2][i]) * kSubpixels;
  for (int y = high(lanes.first[i]);; ++y) {
    std::int32_t value0 = row0;
    std::int32_t value1 = row1;
    std::int32_t value2 = row2;
    Rank* row = origin + static_cast<std::ptrdiff_t>(y) * stride;
    for (int x = first_x;; ++x) {
      if ((value0 | value1 | value2) >= 0) raise(row[x], rank);
      if (x == last_x) break;
      value0 += x0;
      value1 += x1;
      value2 += x2;
    }
    if (y == last_y) break;
    row0 += y0;
    row1 += y1;
    row2 += y2;
  }
}

/// The target's pixels as seen from a cluster's origin, as pairs.
struct Clip {
  Shorts first, last;
};

inline int bounded(int pixel) { return pixel < -256 ? -256 : (pixel > 256 ? 256 : pixel); }

inline Shorts pair(int x, int y) {
  return bits_as<Shorts>(Ints{} + ((bounded(x) & 0xFFFF) | bounded(y) * 65536));
}

template <class Rank>
Clip clip_of(const Kernel<Rank>& kernel, const PixelVertices& vertices) {
  return {pair(-vertices.origin_x, -vertices.origin_y),
          pair(kernel.target.width - 1 - vertices.origin_x,
               kernel.target.height - 1 - vertices.origin_y)};
}

template <class Rank>
void draw_lanes(const Shorts& a, Shorts b, Shorts c, Faces faces, const Clip& clip, Rank* origin,
                int stride, Rank rank) {
  Ints area = dot(b - a, turned(c - a));
  if (faces == Faces::Both) {
    const Ints swap = area < 0;
    const Ints ints_b = bits_as<Ints>(b);
    const Ints ints_c = bits_as<Ints>(c);
    b = bits_as<Shorts>(swap ? ints_c : ints_b);
    c = bits_as<Shorts>(swap ? ints_b : ints_c);
    area = swap ? -area : area;
  }
  const Shorts lo = least(least(a, b), c);
  const Shorts hi = greatest(greatest(a, b), c);
  // Centres lie at 128, 384, ... sub-pixels.
  constexpr std::int16_t kHalf = kSubpixels / 2;
  constexpr std::int16_t kBelowHalf = kHalf - 1;
  const Shorts first = greatest((lo + kBelowHalf) >> kSubpixelBits, clip.first);
  const Shorts last = least((hi - kHalf) >> kSubpixelBits, clip.last);
  const Ints empty = bits_as<Ints>(first > last);
  unsigned some = sign_bits((empty == 0) & (area > 0));
  if (some == 0) return;

  const Shorts center = (first << kSubpixelBits) + kHalf;
  const Shorts ab = b - a;
  const Shorts bc = c - b;
  const Shorts ca = a - c;
  LaneTriangles lanes;
  const Ints value0 = dot(ab, turned(center - a)) + edge_bias(ab);
  const Ints value1 = dot(bc, turned(center - b)) + edge_bias(bc);
  const Ints value2 = dot(ca, turned(center - c)) + edge_bias(ca);
  store(lanes.first, first);
  const Ints single = bits_as<Ints>(first) == bits_as<Ints>(last);
  const unsigned one = sign_bits(single);
  unsigned hit = some & one & ~sign_bits(value0 | value1 | value2);
  for (; hit != 0; hit &= hit - 1) {
    const std::int32_t pixel = lanes.first[__builtin_ctz(hit)];
    raise(origin[static_cast<std::ptrdiff_t>(high(pixel)) * stride + low(pixel)], rank);
  }
  some &= ~one;
  if (some == 0) return;
  store(lanes.last, last);
  store(lanes.value[0], value0);
  store(lanes.value[1], value1);
  store(lanes.value[2], value2);
  store(lanes.edge[0], ab);
  store(lanes.edge[1], bc);
  store(lanes.edge[2], ca);
  for (; some != 0; some &= some - 1) cover(lanes, __builtin_ctz(some), origin, stride, rank);
}

template <class Rank>
void draw_triangles(const Kernel<Rank>& kernel, const ClusterDraw<Rank>& draw,
                    const Cluster& cluster, const PixelVertices& vertices) {
  const Clip clip = clip_of(kernel, vertices);
  Rank* origin = kernel.target.pixels +
                 static_cast<std::ptrdiff_t>(vertices.origin_y) * kernel.target.width +
                 vertices.origin_x;
  const std::uint8_t* corners = draw.corners + cluster.first_corner;
  const int count = cluster.triangles;
  // Front faces are counter-clockwise, which has a negative area where y points down.
  const int second = draw.faces == Faces::Front ? 2 * count : count;
  const int third = 3 * count - second;
  for (int t = 0; t < count; t += kLanes) {
    draw_lanes(gather(vertices.xy, corners + t), gather(vertices.xy, corners + second + t),
               gather(vertices.xy, corners + third + t), draw.faces, clip, origin,
               kernel.target.width, draw.rank);
  }
}

template <class Rank>
KernelResult draw_clusters(const ClusterDraw<Rank>& draw, const ClusterProjection& projection,
                           const RankTarget<Rank>& target, std::uint32_t* too_large) {
  const Kernel<Rank> kernel = make_kernel(projection, target);
  KernelResult result;
  PixelVertices vertices;
  for (std::size_t i = 0; i < draw.count; ++i) {
    const Cluster& cluster = draw.clusters[i];
    if (outside(kernel, cluster)) continue;
    if (draw.faces == Faces::Front && turned_away(kernel, cluster, 1.0F)) continue;
    if (draw.faces == Faces::Back && turned_away(kernel, cluster, -1.0F)) continue;
    const Reach reach = near_plane(kernel, cluster);
    if (reach == Reach::Behind) continue;
    result.triangles += cluster.triangles;
    if (reach == Reach::Beyond &&
        project(kernel, draw.positions + cluster.first_position, cluster.vertices, vertices)) {
      draw_triangles(kernel, draw, cluster, vertices);
    } else {
      too_large[result.too_large++] = static_cast<std::uint32_t>(i);
    }
  }
  return result;
}

}  // namespace

DrawClusters<std::uint8_t> draw_clusters_8() noexcept { return &draw_clusters<std::uint8_t>; }
DrawClusters<std::uint16_t> draw_clusters_16() noexcept { return &draw_clusters<std::uint16_t>; }

}  // namespace NACRE_KERNEL
}  // namespace nacre
