// Which triangles may cover a pixel centre, and their edge functions. A part of
// `cluster_kernel_body.h`. NOLINTBEGIN(modernize-avoid-c-arrays)
namespace nacre::NACRE_KERNEL {
namespace {

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

/// Pixels that some triangles cannot raise: of whole shells' ranks, those that hold a rank as high.
template <class Pixel, bool kCut>
struct RaisedPixels {
  static constexpr bool kKnown = false;
};

template <>
struct RaisedPixels<std::uint8_t, false> {
  static constexpr bool kKnown = true;
  /// Larger rectangles are seldom as bright all over.
  static constexpr int kLargestSide = 8;

  const std::uint8_t* origin;
  std::ptrdiff_t stride;
  std::uint8_t rank;

  /// Four pixels to the right of each other, those up to `columns` asked for: the top bits of those
  /// that are as bright, and of those not asked for. With 128 added, none borrows from the next
  /// when the rank is taken off.
  std::uint32_t hold_in_row(const std::uint8_t* pixels, std::uint32_t asked) const {
    std::uint32_t four = 0;
    __builtin_memcpy(&four, pixels, 4);
    return ((four | kTopBits) - rank * 0x01010101U) | ~asked;
  }

  /// 1 if all of a rectangle is as bright; 0 is always allowed.
  unsigned hold(int x, int y, int columns, int rows) const {
    if (rank >= 128) return 0;  // its bytes would borrow
    const std::uint8_t* first = origin + y * stride + x;
    if (columns < 4 && rows < 4) {  // most: without a branch that depends on them
      const std::uint32_t asked = kTopBits >> (8 * (3 - columns));
      std::uint32_t held = hold_in_row(first, asked);
      for (int dy = 1; dy < 4; ++dy) {
        held &= hold_in_row(first + (dy < rows ? dy : rows) * stride, asked);
      }
      return (held & kTopBits) == kTopBits ? 1 : 0;
    }
    if (columns >= kLargestSide || rows >= kLargestSide) return 0;
    for (int dy = 0; dy <= rows; ++dy) {
      for (int dx = 0; dx <= columns; dx += 4) {
        const int beyond = dx + 3 - columns;
        const std::uint32_t asked = kTopBits >> (beyond > 0 ? 8 * beyond : 0);
        if ((hold_in_row(first + dy * stride + dx, asked) & kTopBits) != kTopBits) return 0;
      }
    }
    return 1;
  }

 private:
  static constexpr std::uint32_t kTopBits = 0x80808080;
};

/// Lists the triangles that are turned the right way, have a centre within their bounds, and may
/// raise a pixel: few, as most triangles are smaller than a pixel, and most of the others lie
/// in front of brighter shells. The list is padded to whole vectors.
template <class Raised>
int list_candidates(const PixelVertices& vertices, const CornerArrays& corners, int count,
                    bool both_faces, const Clip& clip, const Raised& raised, std::uint8_t* list) {
  int listed = 0;
  for (int t = 0; t < count; t += kLanes) {
    Triangles triangles = gather(vertices.xy, corners, t);
    const Ints area = orient(triangles, both_faces).twice;
    const Centers centers = centers_of(triangles, clip);
    const Ints empty = bits_as<Ints>(centers.first > centers.last);
    unsigned some = sign_bits((empty == 0) & (area > 0));
    if (some == 0) continue;
    [[maybe_unused]] alignas(64) std::int16_t first[2 * kLanes];
    [[maybe_unused]] alignas(64) std::int16_t size[2 * kLanes];
    if constexpr (Raised::kKnown) {
      store(first, centers.first);
      store(size, centers.last - centers.first);
    }
    for (; some != 0; some &= some - 1) {
      const int lane = __builtin_ctz(some);
      list[listed++] = static_cast<std::uint8_t>(t + lane);
      if constexpr (Raised::kKnown) {
        const int x = 2 * lane;
        listed -= static_cast<int>(raised.hold(first[x], first[x + 1], size[x], size[x + 1]));
      }
    }
  }
  for (int i = 0; i < kLanes; ++i) list[listed + i] = 0;
  return listed;
}

/// -1 where a centre exactly on the edge is not covered: on lower and right edges.
inline Ints edge_bias(const Shorts& edge) {
  const Ints pairs = bits_as<Ints>(edge);
  const Ints x = (pairs << 16) >> 16;
  const Ints y = pairs >> 16;
  const Ints covered = (y < 0) | ((y == 0) & (x > 0));
  return ~covered;
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

}  // namespace
}  // namespace nacre::NACRE_KERNEL
// NOLINTEND(modernize-avoid-c-arrays)
