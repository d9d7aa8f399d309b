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
