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

using Triangles = Corners<Shorts>;

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

inline Triangles gather(const PixelVertices& vertices, const CornerArrays& corners, int t) {
  const auto [a, b, c] = look_up<Ints>(vertices.xy, vertices.count, corners, t);
  return {bits_as<Shorts>(a), bits_as<Shorts>(b), bits_as<Shorts>(c)};
}

/// Triangles that are left of a cluster's: their numbers, the pixels they may cover, as pairs, and
/// their corners. All have room for a vector beyond the last.
struct Candidates {
  static constexpr int kRoom = kClusterTriangles + kLanePadding + kLanes;
  alignas(64) std::int32_t numbers[kRoom];
  alignas(64) std::int32_t first[kRoom];  // where many are looked at together
  alignas(64) std::int32_t size[kRoom];
  alignas(64) std::uint8_t corners[3][kRoom];
  int count = 0;
};

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
    // A row at a time, all eight pixels to its right.
    constexpr std::uint64_t kEveryByte = 0x0101010101010101U;
    const std::uint64_t asked = (0x80 * kEveryByte) >> (8 * (7 - columns));
    for (int dy = 0; dy <= rows; ++dy) {
      std::uint64_t eight = 0;
      __builtin_memcpy(&eight, first + dy * stride, 8);
      if ((((eight | (0x80 * kEveryByte)) - rank * kEveryByte) & asked) != asked) return 0;
    }
    return 1;
  }

  /// The same for lanes of up to four by four pixels, a bit each. Others take no step down.
  unsigned hold(const Shorts& first, const Ints& columns, const Ints& rows) const {
    const Ints top = Ints{} + static_cast<std::int32_t>(kTopBits);
    const Ints ranks = Ints{} + rank * 0x01010101;
    const Ints asked = (Ints{} + 0x80) | ((columns > 0) & 0x8000) | ((columns > 1) & 0x800000) |
                       ((columns > 2) & static_cast<std::int32_t>(0x80000000));
    Ints offsets = dot(first, both(1, static_cast<int>(stride)));
    Ints held = asked;
    for (int dy = 0;; ++dy) {
      held &= minus(four_bytes(origin, offsets) | top, ranks);
      const Ints further = rows > dy;
      if (dy == 3 || sign_bits(further) == 0) break;
      offsets += further & static_cast<std::int32_t>(stride);
    }
    return sign_bits(held == asked);
  }

 private:
  static constexpr std::uint32_t kTopBits = 0x80808080;
};

/// Of the candidates from `i` on, a vector of them, those that may raise a pixel: a bit each.
inline unsigned raising(const RaisedPixels<std::uint8_t, false>& raised, const Candidates& all,
                        int i) {
  const Ints used = lane_numbers() < all.count - i;
  // Unused lanes look where the first does.
  const Ints pixel = load<Ints>(all.first + i);
  const auto first = bits_as<Shorts>(used ? pixel : Ints{} + pixel[0]);
  const Ints size = used & load<Ints>(all.size + i);
  const Ints columns = (size << 16) >> 16;
  const Ints rows = size >> 16;
  const Ints large = (columns > 3) | (rows > 3);
  unsigned held = raised.hold(first, columns, ~large & rows) & ~sign_bits(large);
  for (unsigned larges = sign_bits(large); larges != 0; larges &= larges - 1) {
    const int lane = __builtin_ctz(larges);
    const int x = 2 * lane;
    held |= raised.hold(first[x], first[x + 1], columns[lane], rows[lane]) << lane;
  }
  return sign_bits(used) & ~held;
}

/// Leaves out what cannot raise a pixel.
inline void keep_raising(const RaisedPixels<std::uint8_t, false>& raised, Candidates& all) {
  if (raised.rank >= 128) return;
  int kept = 0;
  for (int i = 0; i < all.count; i += kLanes) {
    const unsigned lanes = raising(raised, all, i);
    store_lanes(all.numbers + kept, load<Ints>(all.numbers + i), lanes);
    kept += __builtin_popcount(lanes);
  }
  all.count = kept;
}

/// Whether what is done for few of a vector's lanes waits until there are as many as lanes: where
/// there are so many that taking them one by one costs more than putting them together.
constexpr bool kGathersFirst = kLanes > 8;

/// Adds those lanes (a bit each) of the triangles from `t` on that may raise a pixel.
template <class Raised>
void add_candidates(unsigned lanes, int t, const Centers& centers, const Raised& raised,
                    Candidates& out) {
  if constexpr (kGathersFirst) {
    store_lanes(out.numbers + out.count, lane_numbers() + t, lanes);
    if constexpr (Raised::kKnown) {
      store_lanes(out.first + out.count, bits_as<Ints>(centers.first), lanes);
      store_lanes(out.size + out.count, bits_as<Ints>(centers.last - centers.first), lanes);
    }
    out.count += __builtin_popcount(lanes);
  } else if (lanes != 0) {
    [[maybe_unused]] alignas(64) std::int16_t first[2 * kLanes];
    [[maybe_unused]] alignas(64) std::int16_t size[2 * kLanes];
    if constexpr (Raised::kKnown) {
      store(first, centers.first);
      store(size, centers.last - centers.first);
    }
    int count = out.count;
    for (; lanes != 0; lanes &= lanes - 1) {
      const int lane = __builtin_ctz(lanes);
      out.numbers[count++] = t + lane;
      if constexpr (Raised::kKnown) {
        const int x = 2 * lane;
        count -= static_cast<int>(raised.hold(first[x], first[x + 1], size[x], size[x + 1]));
      }
    }
    out.count = count;
  }
}

/// Lists the triangles that are turned the right way, have a centre within their bounds, and may
/// raise a pixel: few, as most triangles are smaller than a pixel, and most of the others lie
/// in front of brighter shells. Corners are padded to whole vectors.
template <class Raised>
void list_candidates(const PixelVertices& vertices, const CornerArrays& corners, int count,
                     bool both_faces, const Clip& clip, const Raised& raised, Candidates& out) {
  out.count = 0;
  for (int t = 0; t < count; t += kLanes) {
    Triangles triangles = gather(vertices, corners, t);
    const Ints area = orient(triangles, both_faces).twice;
    const Centers centers = centers_of(triangles, clip);
    const Ints empty = bits_as<Ints>(centers.first > centers.last);
    add_candidates(sign_bits((empty == 0) & (area > 0)), t, centers, raised, out);
  }
  if constexpr (kGathersFirst && Raised::kKnown) keep_raising(raised, out);
  for (int i = 0; i < out.count; ++i) {
    const int t = out.numbers[i];
    out.corners[0][i] = corners.first[t];
    out.corners[1][i] = corners.second[t];
    out.corners[2][i] = corners.third[t];
  }
  for (auto& corner : out.corners) __builtin_memset(corner + out.count, 0, kLanes);
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
