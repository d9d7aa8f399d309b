// The pixels that triangles cover, and their brightness. A part of `cluster_kernel_body.h`.
// NOLINTBEGIN(modernize-avoid-c-arrays)
namespace nacre::NACRE_KERNEL {
namespace {

/// Depths of the lanes' triangles at their three corners; nothing where depth does not matter.
template <bool kDepth>
struct CornerDepths {
  Floats at(const Edges&, const Ints&, const Ints&, const Ints&) const { return Floats{}; }
  CornerDepths of_lane(int) const { return {}; }
};

template <>
struct CornerDepths<true> {
  Floats corner[3];  // opposite to edges 0, 1 and 2; see `PixelVertices::depth`
  bool perspective;

  /// From the corners, weighed by the edges opposite to them.
  Floats at(const Edges& edges, const Ints& value0, const Ints& value1, const Ints& value2) const {
    // Without the bias they add up to twice the area, which is 1 at least.
    const Floats weight0 = __builtin_convertvector(value0 - edges.bias[0], Floats);
    const Floats weight1 = __builtin_convertvector(value1 - edges.bias[1], Floats);
    const Floats weight2 = __builtin_convertvector(value2 - edges.bias[2], Floats);
    const Floats sum = weight0 + weight1 + weight2;
    const Floats weighed = weight0 * corner[0] + weight1 * corner[1] + weight2 * corner[2];
    return perspective ? sum / weighed : weighed / sum;
  }

  /// The same for one lane's triangle in all lanes.
  CornerDepths of_lane(int lane) const {
    CornerDepths depths = *this;
    for (int k = 0; k < 3; ++k) depths.corner[k] = Floats{} + corner[k][lane];
    return depths;
  }
};

/// What lanes put into pixels at a depth: the rank of a shell ...
template <class Pixel>
struct Source {
  Pixel rank;

  struct Lanes {
    Pixel rank;
    Pixel operator[](int) const { return rank; }
  };
  Lanes at(const Floats&) const { return {rank}; }
  Source of_lane(int) const { return *this; }
};

/// ... or its emission under a cue ...
template <>
struct Source<float> {
  glm::vec2 z_of_depth;
  Brightness<float> brightness;

  Floats at(const Floats& depth) const {
    const Floats z = z_of_depth.x + z_of_depth.y * depth;
    const Floats inside = least(greatest(z, Floats{}), Floats{} + 1.0F);
    return brightness.at_far + (brightness.at_near - brightness.at_far) * inside;
  }
  Source of_lane(int) const { return *this; }
};

/// ... or the side on which it is crossed ...
template <>
struct Source<std::int32_t> {
  Ints leaving;  // 1: a back face, -1: a front face

  Ints at(const Floats&) const { return leaving; }
  Source of_lane(int lane) const { return {Ints{} + leaving[lane]}; }
};

/// ... or what a crossing adds to a sum ...
template <>
struct Source<std::int64_t> {
  Brightness<std::int64_t> brightness;
  float start_mm;
  Ints negative;  // -1: taken off

  Ints at(const Floats& depth) const {
    // Lanes beside their triangle may have any depth, or none.
    const Floats most = Floats{} + brightness.most_depth_mm;
    const Floats bounded = least(greatest(depth - start_mm, Floats{}), most);
    const Ints steps = __builtin_convertvector(steps_at(bounded), Ints);
    return (steps ^ negative) - negative;
  }

  /// The same for one lane where its ray may start after it and end before it.
  std::int32_t within(float depth_mm, float end_mm, int lane) const {
    if (brightness.is_signed) {
      const float most = end_mm < brightness.most_depth_mm ? end_mm : brightness.most_depth_mm;
      depth_mm = depth_mm < most ? depth_mm : most;
      depth_mm = depth_mm > 0.0F ? depth_mm : 0.0F;
    } else if (!(depth_mm >= 0.0F && depth_mm <= end_mm)) {
      return 0;
    }
    const auto steps = static_cast<std::int32_t>(steps_at(depth_mm));
    return (steps ^ negative[lane]) - negative[lane];
  }

  Source of_lane(int lane) const { return {brightness, start_mm, Ints{} + negative[lane]}; }

 private:
  template <class Depth>
  Depth steps_at(const Depth& d) const {
    return brightness.constant + d * (brightness.linear + brightness.square * d);
  }
};

/// ... or a triangle and its depth, as in `key_of`.
template <>
struct Source<std::uint64_t> {
  float start_mm;
  Ints numbers;  // complements

  struct Lanes {
    Ints nearness;
    Ints numbers;
    std::uint64_t operator[](int lane) const {
      return std::uint64_t{static_cast<std::uint32_t>(nearness[lane])} << 32U |
             static_cast<std::uint32_t>(numbers[lane]);
    }
  };
  Lanes at(const Floats& depth) const {
    const Ints bits = bits_as<Ints>(depth - start_mm);
    const Ints sign = Ints{} + static_cast<std::int32_t>(0x80000000);
    const Ints ordered = bits ^ ((bits >> 31) | sign);
    return {~ordered, numbers};
  }
  Source of_lane(int lane) const { return {start_mm, Ints{} + numbers[lane]}; }
};

/// Pixels, and where their rays end.
template <class Pixel, bool kCut>
struct Canvas {
  Pixel* pixels;
  const float* ends_mm;

  Canvas at(std::ptrdiff_t offset) const {
    if constexpr (kCut) return {pixels + offset, ends_mm + offset};
    return {pixels + offset, nullptr};
  }
};

/// What lanes put into pixels, one each. 0 changes nothing.
template <class Pixel, bool kCut>
struct Fragments {
  decltype(Source<Pixel>{}.at(Floats{})) values;
  Floats depth_mm;  // beyond the start of the ray, where rays are cut

  void put(const Canvas<Pixel, kCut>& canvas, std::ptrdiff_t offset, int lane) const {
    Pixel value = values[lane];
    if constexpr (kCut) {
      const float depth = depth_mm[lane];
      const float end = canvas.ends_mm[offset];
      const bool shows = kCounts<Pixel> ? depth > end : depth >= 0.0F && depth <= end;
      value = shows ? value : Pixel{0};
    }
    Pixel& pixel = canvas.pixels[offset];
    if constexpr (kCounts<Pixel> || kSums<Pixel>) {
      pixel += value;
    } else {
      pixel = pixel < value ? value : pixel;
    }
  }
};

/// Of sums, each lane adds what is left of it between start and end of its own ray.
template <>
struct Fragments<std::int64_t, true> {
  const Source<std::int64_t>& source;
  Floats depth_mm;

  void put(const Canvas<std::int64_t, true>& canvas, std::ptrdiff_t offset, int lane) const {
    canvas.pixels[offset] += source.within(depth_mm[lane], canvas.ends_mm[offset], lane);
  }
};

/// What triangles put into pixels.
template <class Pixel, bool kCut>
struct Shade {
  CornerDepths<kCut || kDeep<Pixel>> depths;
  Source<Pixel> source;
  float start_mm;

  Fragments<Pixel, kCut> at(const Edges& edges, const Ints& value0, const Ints& value1,
                            const Ints& value2) const {
    const Floats depth = depths.at(edges, value0, value1, value2);
    if constexpr (kCut && kSums<Pixel>) {
      return {source, depth - start_mm};
    } else {
      return {source.at(depth), depth - start_mm};
    }
  }
  Shade of_lane(int lane) const { return {depths.of_lane(lane), source.of_lane(lane), start_mm}; }
};

/// Up to this side, triangles are walked side by side, one a lane; larger ones one by one.
constexpr int kSmallSide = 4;

/// Covers small triangles: all lanes step through the largest of their rectangles together.
template <class Pixel, bool kCut>
void cover_small(Edges edges, const Ints& columns, const Ints& rows, const std::int32_t* offsets,
                 int most_columns, int most_rows, const Canvas<Pixel, kCut>& origin,
                 std::ptrdiff_t stride, const Shade<Pixel, kCut>& shade) {
  for (int y = 0;; ++y) {
    Ints value0 = edges.value[0];
    Ints value1 = edges.value[1];
    Ints value2 = edges.value[2];
    const Ints beyond_row = rows - y;
    const Canvas<Pixel, kCut> row = origin.at(y * stride);
    for (int x = 0;; ++x) {
      unsigned hit = (1U << kLanes) - 1;
      hit &= ~sign_bits(value0 | value1 | value2 | (columns - x) | beyond_row);
      if (hit != 0) {
        const auto fragments = shade.at(edges, value0, value1, value2);
        for (; hit != 0; hit &= hit - 1) {
          const int lane = __builtin_ctz(hit);
          fragments.put(row, offsets[lane] + x, lane);
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

/// Bytes side by side, one for each lane.
using Bytes [[gnu::vector_size(kLanes)]] = std::uint8_t;
using SignedBytes [[gnu::vector_size(kLanes)]] = std::int8_t;

/// Raises pixels side by side to a rank where the lanes are not negative. Pixels beside them, up to
/// `kPixelPadding` behind the last, are written as they are.
inline void raise_row(std::uint8_t* pixels, const Ints& lanes, std::uint8_t rank) {
  const Ints inside = ~(lanes >> 31);
  const auto ranks =
      bits_as<Bytes>(__builtin_convertvector(inside, SignedBytes)) & (Bytes{} + rank);
  store(pixels, greatest(load<Bytes>(pixels), ranks));
}

/// Covers one triangle, pixels side by side.
template <class Pixel, bool kCut>
void cover_large(Edges edges, int columns, int rows, const Canvas<Pixel, kCut>& first,
                 std::ptrdiff_t stride, const Shade<Pixel, kCut>& shade) {
  for (int y = 0; y <= rows; ++y) {
    Ints value0 = edges.value[0];
    Ints value1 = edges.value[1];
    Ints value2 = edges.value[2];
    const Canvas<Pixel, kCut> row = first.at(y * stride);
    for (int x = 0; x <= columns; x += kLanes) {
      const Ints left = columns - x - lane_numbers();
      const Ints outside = value0 | value1 | value2 | left;
      if constexpr (sizeof(Pixel) == 1 && !kCut) {
        raise_row(row.pixels + x, outside, shade.source.rank);
      } else {
        unsigned hit = (1U << kLanes) - 1;
        hit &= ~sign_bits(outside);
        const auto fragments = shade.at(edges, value0, value1, value2);
        if (hit == (1U << kLanes) - 1) {
          for (int i = 0; i < kLanes; ++i) fragments.put(row, x + i, i);
        } else {
          for (; hit != 0; hit &= hit - 1) {
            const int i = __builtin_ctz(hit);
            fragments.put(row, x + i, i);
          }
        }
      }
      value0 += edges.step_x[0];
      value1 += edges.step_x[1];
      value2 += edges.step_x[2];
    }
    for (int k = 0; k < 3; ++k) edges.value[k] += edges.step_y[k];
  }
}

/// Covers the first `used` of the lanes' triangles, which are oriented.
template <class Pixel, bool kCut>
void cover(const Triangles& triangles, int used, const Clip& clip,
           const Canvas<Pixel, kCut>& origin, int stride, const Shade<Pixel, kCut>& shade) {
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
  const int most_columns = greatest_lane<IntQuad>(small_columns);
  if (most_columns >= 0) {
    const int most_rows = greatest_lane<IntQuad>(small_columns < 0 ? small_columns : rows);
    cover_small(edges, small_columns, rows, offsets, most_columns, most_rows, origin, stride,
                shade);
  }
  for (unsigned larges = sign_bits(large); larges != 0; larges &= larges - 1) {
    const int lane = __builtin_ctz(larges);
    cover_large(side_by_side(edges, lane), columns[lane], rows[lane], origin.at(offsets[lane]),
                stride, shade.of_lane(lane));
  }
}

}  // namespace
}  // namespace nacre::NACRE_KERNEL
// NOLINTEND(modernize-avoid-c-arrays)
