// The pixels that triangles cover, and their brightness. A part of `cluster_kernel_body.h`.
// NOLINTBEGIN(modernize-avoid-c-arrays)
namespace nacre::NACRE_KERNEL {
namespace {

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

}  // namespace
}  // namespace nacre::NACRE_KERNEL
// NOLINTEND(modernize-avoid-c-arrays)
