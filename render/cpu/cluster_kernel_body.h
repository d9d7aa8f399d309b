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
template <class Pixel>
struct Kernel {
  const ClusterProjection& projection;
  const PixelTarget<Pixel>& target;
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

template <class Pixel>
Kernel<Pixel> make_kernel(const ClusterProjection& projection, const PixelTarget<Pixel>& target) {
  Kernel<Pixel> kernel{projection,
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

template <class Pixel>
bool outside(const Kernel<Pixel>& kernel, const Cluster& cluster) {
  const auto& c = cluster.center_mm;
  const auto& e = cluster.extent_mm;
  const Quad most = kernel.plane_x * c.x + kernel.plane_y * c.y + kernel.plane_z * c.z +
                    kernel.plane_w + magnitude(kernel.plane_x) * e.x +
                    magnitude(kernel.plane_y) * e.y + magnitude(kernel.plane_z) * e.z;
  return most[0] < 0.0F || most[1] < 0.0F || most[2] < 0.0F || most[3] < 0.0F;
}

/// Whether all triangles face away from the eye (`sign` 1) or all towards it (-1).
template <class Pixel>
bool turned_away(const Kernel<Pixel>& kernel, const Cluster& cluster, float sign) {
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

template <class Pixel>
Reach near_plane(const Kernel<Pixel>& kernel, const Cluster& cluster) {
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

/// Whether pixels hold emission that depends on depth.
template <class Pixel>
constexpr bool kCued = false;
template <>
constexpr bool kCued<float> = true;

struct PixelVertices {
  alignas(64) float x[256];  // pixels
  alignas(64) float y[256];
  alignas(64) float depth[256];      // z, or 1 / w (perspective); for pixels with a cue only
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
template <class Pixel>
bool project(const Kernel<Pixel>& kernel, const float* positions, int count, PixelVertices& out) {
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
      if constexpr (kCued<Pixel>) store(out.depth + i, over_w);
    } else if constexpr (kCued<Pixel>) {
      store(out.depth + i, row_at(projection.row_z, x, y, z));
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

/// The target's pixels as seen from a cluster's origin, as pairs.
struct Clip {
  Shorts first, last;
};

inline int bounded(int pixel) { return pixel < -256 ? -256 : (pixel > 256 ? 256 : pixel); }

inline Shorts both(int x, int y) { return bits_as<Shorts>(Ints{} + ((x & 0xFFFF) | y * 65536)); }

template <class Pixel>
Clip clip_of(const Kernel<Pixel>& kernel, const PixelVertices& vertices) {
  return {both(bounded(-vertices.origin_x), bounded(-vertices.origin_y)),
          both(bounded(kernel.target.width - 1 - vertices.origin_x),
               bounded(kernel.target.height - 1 - vertices.origin_y))};
}

/// Corners of as many triangles as there are lanes.
struct Triangles {
  Shorts a, b, c;
};

/// Pixels whose centres may be covered.
struct Centers {
  Shorts first, last;
};

inline Centers centers_of(const Triangles& triangles, const Clip& clip) {
  const Shorts lo = least(least(triangles.a, triangles.b), triangles.c);
  const Shorts hi = greatest(greatest(triangles.a, triangles.b), triangles.c);
  // Centres lie at 128, 384, ... sub-pixels.
  constexpr std::int16_t kHalf = kSubpixels / 2;
  constexpr std::int16_t kBelowHalf = kHalf - 1;
  return {greatest((lo + kBelowHalf) >> kSubpixelBits, clip.first),
          least((hi - kHalf) >> kSubpixelBits, clip.last)};
}

/// Of triangles, positive for the faces drawn, and which had to be turned for that.
struct Areas {
  Ints twice;
  Ints swapped;
};

/// Exchanges the second and third corner of back faces where both faces are drawn.
inline Areas orient(Triangles& triangles, bool both_faces) {
  const Ints area = dot(triangles.b - triangles.a, turned(triangles.c - triangles.a));
  if (!both_faces) return {area, Ints{}};
  const Ints swap = area < 0;
  const Ints b = bits_as<Ints>(triangles.b);
  const Ints c = bits_as<Ints>(triangles.c);
  triangles.b = bits_as<Shorts>(swap ? c : b);
  triangles.c = bits_as<Shorts>(swap ? b : c);
  return {swap ? -area : area, swap};
}

/// The corners of a cluster's triangles, in the order in which the faces drawn are clockwise.
struct CornerArrays {
  const std::uint8_t* first;
  const std::uint8_t* second;
  const std::uint8_t* third;
};

inline Triangles gather(const std::int32_t* vertices, const CornerArrays& corners, int t) {
  return {gather(vertices, corners.first + t), gather(vertices, corners.second + t),
          gather(vertices, corners.third + t)};
}

inline Triangles gather_listed(const std::int32_t* vertices, const CornerArrays& corners,
                               const std::uint8_t* list) {
  Ints a;
  Ints b;
  Ints c;
  for (int i = 0; i < kLanes; ++i) {
    a[i] = vertices[corners.first[list[i]]];
    b[i] = vertices[corners.second[list[i]]];
    c[i] = vertices[corners.third[list[i]]];
  }
  return {bits_as<Shorts>(a), bits_as<Shorts>(b), bits_as<Shorts>(c)};
}

/// Lists the triangles that are turned the right way and have a centre within their bounds: few, as
/// most triangles are smaller than a pixel. The list is padded to whole vectors.
inline int list_candidates(const PixelVertices& vertices, const CornerArrays& corners, int count,
                           bool both_faces, const Clip& clip, std::uint8_t* list) {
  int listed = 0;
  for (int t = 0; t < count; t += kLanes) {
    Triangles triangles = gather(vertices.xy, corners, t);
    const Ints area = orient(triangles, both_faces).twice;
    const Centers centers = centers_of(triangles, clip);
    const Ints empty = bits_as<Ints>(centers.first > centers.last);
    unsigned some = sign_bits((empty == 0) & (area > 0));
    for (; some != 0; some &= some - 1) {
      list[listed++] = static_cast<std::uint8_t>(t + __builtin_ctz(some));
    }
  }
  for (int i = 0; i < kLanes; ++i) list[listed + i] = 0;
  return listed;
}

/// The three edge functions of triangles, not negative where a centre is covered.
struct Edges {
  Ints value[3];  // at the pixel where a walk stands, biased
  Ints bias[3];
  Ints step_x[3];  // from pixel to pixel
  Ints step_y[3];
};

inline void set_edge(Edges& edges, int k, const Shorts& from, const Shorts& to,
                     const Shorts& center) {
  const Shorts edge = to - from;
  const Ints pairs = bits_as<Ints>(edge);
  edges.bias[k] = edge_bias(edge);
  edges.value[k] = dot(edge, turned(center - from)) + edges.bias[k];
  edges.step_x[k] = -(pairs >> 16) << kSubpixelBits;
  edges.step_y[k] = (pairs << 16) >> (16 - kSubpixelBits);
}

inline Edges edges_of(const Triangles& triangles, const Shorts& first) {
  constexpr std::int16_t kHalf = kSubpixels / 2;
  const Shorts center = (first << kSubpixelBits) + kHalf;
  Edges edges;
  set_edge(edges, 0, triangles.a, triangles.b, center);
  set_edge(edges, 1, triangles.b, triangles.c, center);
  set_edge(edges, 2, triangles.c, triangles.a, center);
  return edges;
}

template <class Pixel>
inline void raise(Pixel& pixel, Pixel value) {
  pixel = pixel < value ? value : pixel;
}

/// The brightness of a shell's pixels: its rank.
template <class Pixel>
struct Shade {
  Pixel rank;

  struct Lanes {
    Pixel rank;
    Pixel operator[](int) const { return rank; }
  };
  Lanes at(const Edges&, const Ints&, const Ints&, const Ints&) const { return {rank}; }
  Shade of_lane(int) const { return *this; }
};

/// With a cue: from the depths of the three corners, weighed by the edges opposite to them.
template <>
struct Shade<float> {
  Floats depth[3];  // of the corners opposite to edges 0, 1 and 2
  glm::vec2 z_of_w;
  bool perspective;
  Brightness<float> brightness;

  Floats at(const Edges& edges, const Ints& value0, const Ints& value1, const Ints& value2) const {
    // Without the bias they add up to twice the area, which is 1 at least.
    const Floats weight0 = __builtin_convertvector(value0 - edges.bias[0], Floats);
    const Floats weight1 = __builtin_convertvector(value1 - edges.bias[1], Floats);
    const Floats weight2 = __builtin_convertvector(value2 - edges.bias[2], Floats);
    const Floats mean = (weight0 * depth[0] + weight1 * depth[1] + weight2 * depth[2]) /
                        (weight0 + weight1 + weight2);
    const Floats z = perspective ? z_of_w.x + z_of_w.y / mean : mean;
    const Floats inside = least(greatest(z, Floats{}), Floats{} + 1.0F);
    return brightness.at_far + (brightness.at_near - brightness.at_far) * inside;
  }

  /// The same for one lane's triangle in all lanes.
  Shade of_lane(int lane) const {
    Shade shade = *this;
    for (int k = 0; k < 3; ++k) shade.depth[k] = Floats{} + depth[k][lane];
    return shade;
  }
};

/// Up to this side, triangles are walked side by side, one a lane; larger ones one by one.
constexpr int kSmallSide = 4;

/// Covers small triangles: all lanes step through the largest of their rectangles together.
template <class Pixel>
void cover_small(Edges edges, const Ints& columns, const Ints& rows, const std::int32_t* offsets,
                 int most_columns, int most_rows, Pixel* origin, std::ptrdiff_t stride,
                 const Shade<Pixel>& shade) {
  for (int y = 0;; ++y) {
    Ints value0 = edges.value[0];
    Ints value1 = edges.value[1];
    Ints value2 = edges.value[2];
    const Ints beyond_row = rows - y;
    Pixel* row = origin + y * stride;
    for (int x = 0;; ++x) {
      unsigned hit = (1U << kLanes) - 1;
      hit &= ~sign_bits(value0 | value1 | value2 | (columns - x) | beyond_row);
      if (hit != 0) {
        const auto values = shade.at(edges, value0, value1, value2);
        for (; hit != 0; hit &= hit - 1) {
          const int lane = __builtin_ctz(hit);
          raise<Pixel>(row[offsets[lane] + x], values[lane]);
        }
      }
      if (x == most_columns) break;
      value0 += edges.step_x[0];
      value1 += edges.step_x[1];
      value2 += edges.step_x[2];
    }
    if (y == most_rows) break;
    for (int k = 0; k < 3; ++k) edges.value[k] += edges.step_y[k];
  }
}

/// 0, 1, 2, ...
inline Ints lane_numbers() {
  Ints numbers;
  for (int i = 0; i < kLanes; ++i) numbers[i] = i;
  return numbers;
}

/// One lane's edges in all lanes, each a pixel further to the right.
inline Edges side_by_side(const Edges& edges, int lane) {
  Edges all;
  for (int k = 0; k < 3; ++k) {
    all.value[k] = edges.value[k][lane] + lane_numbers() * edges.step_x[k][lane];
    all.bias[k] = Ints{} + edges.bias[k][lane];
    all.step_x[k] = Ints{} + kLanes * edges.step_x[k][lane];
    all.step_y[k] = Ints{} + edges.step_y[k][lane];
  }
  return all;
}

/// Covers one triangle, pixels side by side.
template <class Pixel>
void cover_large(Edges edges, int columns, int rows, Pixel* first, std::ptrdiff_t stride,
                 const Shade<Pixel>& shade) {
  for (int y = 0; y <= rows; ++y) {
    Ints value0 = edges.value[0];
    Ints value1 = edges.value[1];
    Ints value2 = edges.value[2];
    Pixel* row = first + y * stride;
    for (int x = 0; x <= columns; x += kLanes) {
      const Ints left = columns - x - lane_numbers();
      unsigned hit = (1U << kLanes) - 1;
      hit &= ~sign_bits(value0 | value1 | value2 | left);
      const auto values = shade.at(edges, value0, value1, value2);
      if (hit == (1U << kLanes) - 1) {
        for (int i = 0; i < kLanes; ++i) raise<Pixel>(row[x + i], values[i]);
      } else {
        for (; hit != 0; hit &= hit - 1) {
          const int i = __builtin_ctz(hit);
          raise<Pixel>(row[x + i], values[i]);
        }
      }
      value0 += edges.step_x[0];
      value1 += edges.step_x[1];
      value2 += edges.step_x[2];
    }
    for (int k = 0; k < 3; ++k) edges.value[k] += edges.step_y[k];
  }
}

inline int greatest_lane(const Ints& v) {
  int most = v[0];
  for (int i = 1; i < kLanes; ++i) most = v[i] > most ? v[i] : most;
  return most;
}

/// Covers the first `used` of the lanes' triangles, which are oriented.
template <class Pixel>
void cover(const Triangles& triangles, int used, const Clip& clip, Pixel* origin, int stride,
           const Shade<Pixel>& shade) {
  const Centers centers = centers_of(triangles, clip);
  const Edges edges = edges_of(triangles, centers.first);
  const Ints size = bits_as<Ints>(centers.last - centers.first);
  const Ints columns = (size << 16) >> 16;
  const Ints rows = size >> 16;
  alignas(64) std::int32_t offsets[kLanes];
  store(offsets, dot(centers.first, both(1, stride)));
  const Ints unused = lane_numbers() >= used;
  const Ints large = ~unused & ((columns >= kSmallSide) | (rows >= kSmallSide));
  const Ints small_columns = columns | unused | large;  // -1: nothing to walk
  const int most_columns = greatest_lane(small_columns);
  if (most_columns >= 0) {
    const int most_rows = greatest_lane(small_columns < 0 ? small_columns : rows);
    cover_small(edges, small_columns, rows, offsets, most_columns, most_rows, origin, stride,
                shade);
  }
  for (unsigned larges = sign_bits(large); larges != 0; larges &= larges - 1) {
    const int lane = __builtin_ctz(larges);
    cover_large<Pixel>(side_by_side(edges, lane), columns[lane], rows[lane], origin + offsets[lane],
                       stride, shade.of_lane(lane));
  }
}

inline Floats gather_depths(const float* depths, const std::uint8_t* corners,
                            const std::uint8_t* list) {
  Floats gathered;
  for (int i = 0; i < kLanes; ++i) gathered[i] = depths[corners[list[i]]];
  return gathered;
}

/// @param swap  lanes whose second and third corners were exchanged
template <class Pixel>
Shade<Pixel> shade_of(const ClusterDraw<Pixel>& draw, const ClusterProjection& projection,
                      const PixelVertices& vertices, const CornerArrays& corners,
                      const std::uint8_t* list, const Ints& swap) {
  if constexpr (kCued<Pixel>) {
    const Floats a = gather_depths(vertices.depth, corners.first, list);
    const Floats b = gather_depths(vertices.depth, corners.second, list);
    const Floats c = gather_depths(vertices.depth, corners.third, list);
    return {{swap ? b : c, a, swap ? c : b},
            projection.z_of_w,
            projection.perspective,
            draw.brightness};
  } else {
    return {draw.brightness.rank};
  }
}

template <class Pixel>
void draw_triangles(const Kernel<Pixel>& kernel, const ClusterDraw<Pixel>& draw,
                    const Cluster& cluster, const PixelVertices& vertices) {
  const Clip clip = clip_of(kernel, vertices);
  const int stride = kernel.target.width;
  Pixel* origin = kernel.target.pixels + static_cast<std::ptrdiff_t>(vertices.origin_y) * stride +
                  vertices.origin_x;
  const std::uint8_t* first = draw.corners + cluster.first_corner;
  const int count = cluster.triangles;
  // Front faces are counter-clockwise, which has a negative area where y points down.
  const int second = draw.faces == Faces::Front ? 2 * count : count;
  const CornerArrays corners{first, first + second, first + 3 * count - second};
  const bool both_faces = draw.faces == Faces::Both;
  alignas(64) std::uint8_t list[kClusterTriangles + kLanePadding + kLanes];
  const int listed = list_candidates(vertices, corners, count, both_faces, clip, list);
  for (int i = 0; i < listed; i += kLanes) {
    Triangles triangles = gather_listed(vertices.xy, corners, list + i);
    const Ints swap = orient(triangles, both_faces).swapped;
    cover(triangles, listed - i, clip, origin, stride,
          shade_of(draw, kernel.projection, vertices, corners, list + i, swap));
  }
}

template <class Pixel>
KernelResult draw_clusters(const ClusterDraw<Pixel>& draw, const ClusterProjection& projection,
                           const PixelTarget<Pixel>& target, std::uint32_t* too_large) {
  const Kernel<Pixel> kernel = make_kernel(projection, target);
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
DrawClusters<float> draw_clusters_cued() noexcept { return &draw_clusters<float>; }

}  // namespace NACRE_KERNEL
}  // namespace nacre
