// Clusters that cannot show, and the vertices of the others as sub-pixels. A part of
// `cluster_kernel_body.h`. NOLINTBEGIN(modernize-avoid-c-arrays)
namespace nacre::NACRE_KERNEL {
namespace {

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

/// What part of a cluster lies between the start and end of rays.
enum class Part { None, Some, All };

struct Extent {
  float lo, hi;
};

/// Depths of a cluster, beyond the start of the rays.
template <class Pixel>
Extent depths_of(const Kernel<Pixel>& kernel, const Cluster& cluster) {
  const ClusterProjection& projection = kernel.projection;
  const auto& row = projection.perspective ? projection.row_w : projection.row_depth;
  const auto& c = cluster.center_mm;
  const auto& e = cluster.extent_mm;
  const float middle = row.x * c.x + row.y * c.y + row.z * c.z + row.w - projection.start_mm;
  const float reach =
      __builtin_fabsf(row.x) * e.x + __builtin_fabsf(row.y) * e.y + __builtin_fabsf(row.z) * e.z;
  return {middle - reach, middle + reach};
}

/// Whether what pixels hold depends on depth.
template <class Pixel>
constexpr bool kDeep = false;
template <>
constexpr bool kDeep<float> = true;
template <>
constexpr bool kDeep<std::int64_t> = true;
template <>
constexpr bool kDeep<std::uint64_t> = true;

/// Whether crossings beyond the end of a ray count as at its end.
template <class Pixel>
bool counts_beyond(const Brightness<Pixel>& brightness) {
  if constexpr (kSums<Pixel>) return brightness.is_signed;
  return false;
}

/// What part of the cluster shows, or, for numbers of shells, lies beyond the ends.
template <class Pixel>
Part part_of(const Kernel<Pixel>& kernel, const ClusterDraw<Pixel>& draw, const Cluster& cluster) {
  const RayEnds* ends = draw.ends;
  if (ends == nullptr) return Part::All;
  const Extent depths = depths_of(kernel, cluster);
  if constexpr (kCounts<Pixel>) {
    return depths.hi > ends->least_mm ? Part::Some : Part::None;
  } else {
    if (depths.hi < 0.0F) return Part::None;
    if (depths.lo > ends->greatest_mm && !counts_beyond<Pixel>(draw.brightness)) return Part::None;
    return depths.lo >= 0.0F && depths.hi <= ends->least_mm ? Part::All : Part::Some;
  }
}

struct PixelVertices {
  alignas(64) float x[256];  // pixels
  alignas(64) float y[256];
  alignas(64) float depth[256];      // or 1 / depth (perspective); where needed
  alignas(64) std::int32_t xy[256];  // sub-pixels from the origin, x in the lower half
  int origin_x, origin_y;            // a pixel
  int count;                         // padded
};

/// Adding 1.5 * 2^23 rounds to the nearest integer and leaves it in the lowest bits.
constexpr float kRound = 12582912.0F;

inline Extent extent_of(const Floats& lo, const Floats& hi) {
  return {least_lane(lo), greatest_lane<Quad>(hi)};
}

inline Floats row_at(const glm::vec4& row, const Floats& x, const Floats& y, const Floats& z) {
  return row.x * x + row.y * y + row.z * z + row.w;
}

/// Projects and rounds. False if the cluster is too large.
template <bool kDepth, class Pixel>
bool project(const Kernel<Pixel>& kernel, const float* positions, int count, PixelVertices& out) {
  const ClusterProjection& projection = kernel.projection;
  out.count = count;
  Floats lo_x = Floats{} + 1e30F;
  Floats lo_y = lo_x;
  Floats hi_x = -lo_x;
  Floats hi_y = -lo_x;
  for (int i = 0; i < count; i += kLanes) {
    const auto x = load<Floats>(positions + i);
    const auto y = load<Floats>(positions + count + i);
    const auto z = load<Floats>(positions + std::ptrdiff_t{2} * count + i);
    Floats clip_x = row_at(projection.row_x, x, y, z);
    Floats clip_y = row_at(projection.row_y, x, y, z);
    if (projection.perspective) {
      const Floats over_w = 1.0F / row_at(projection.row_w, x, y, z);
      clip_x *= over_w;
      clip_y *= over_w;
      if constexpr (kDepth) store(out.depth + i, over_w);
    } else if constexpr (kDepth) {
      store(out.depth + i, row_at(projection.row_depth, x, y, z));
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
  // Rounded before the origin is taken off: neighbouring clusters have different origins, but
  // share vertices.
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

}  // namespace
}  // namespace nacre::NACRE_KERNEL
// NOLINTEND(modernize-avoid-c-arrays)
