// The kernel's one source, included once for each instruction set with NACRE_KERNEL (a namespace)
// and NACRE_VECTOR_BYTES defined. No inline function from elsewhere: see cell_kernel.h.
// NOLINTBEGIN(modernize-avoid-c-arrays)

namespace nacre::NACRE_KERNEL {
namespace {

constexpr int kLanes = NACRE_VECTOR_BYTES / 8;
constexpr int kSamples = BrickSamples::kSamples;

using Doubles [[gnu::vector_size(NACRE_VECTOR_BYTES)]] = double;
using Mask [[gnu::vector_size(NACRE_VECTOR_BYTES)]] = long long;

inline Doubles load(const double* from) {
  Doubles vector;
  __builtin_memcpy(&vector, from, sizeof vector);
  return vector;
}

inline void store(double* to, const Doubles& vector) {
  __builtin_memcpy(to, &vector, sizeof vector);
}

inline Doubles least(const Doubles& a, const Doubles& b) { return a < b ? a : b; }
inline Doubles greatest(const Doubles& a, const Doubles& b) { return a > b ? a : b; }

/// One bit a lane.
inline unsigned bits(const Mask& mask) {
#if NACRE_VECTOR_BYTES == 32
  return static_cast<unsigned>(__builtin_ia32_movmskpd256(__builtin_bit_cast(Doubles, mask)));
#elif defined(__SSE2__)
  return static_cast<unsigned>(__builtin_ia32_movmskpd(__builtin_bit_cast(Doubles, mask)));
#else
  unsigned result = 0;
  for (int lane = 0; lane < kLanes; ++lane) result |= mask[lane] != 0 ? 1U << lane : 0U;
  return result;
#endif
}

template <class A, class B>
inline Doubles mix(const A& a, const B& b, const Doubles& s) {
  return a + (b - a) * s;
}

constexpr long sample_at(long x, long y, long z) { return x + kSamples * (y + kSamples * z); }

/// A cell's corners, x + 2 y + 4 z, and the differences along x.
struct Corners {
  double at[8];
  double first[3];  ///< the lower corner's place
};

inline Corners corners_of(const BrickSamples& brick, const BrickCell& cell) {
  const double* base = brick.sample + sample_at(cell.x, cell.y, cell.z);
  constexpr int kY = kSamples;
  constexpr int kZ = kSamples * kSamples;
  return {
      {base[0], base[1], base[kY], base[kY + 1], base[kZ], base[kZ + 1], base[kZ + kY],
       base[kZ + kY + 1]},
      {brick.first_cell[0] + cell.x, brick.first_cell[1] + cell.y, brick.first_cell[2] + cell.z}};
}

/// What some rays are within a cell.
struct Passage {
  Doubles t_enter;
  Doubles t_exit;
  Mask inside;
};

/// Each plane's t is one expression of the plane alone, so that neighbours agree on it.
template <bool kSlack>
inline Passage pass(const LaneRays& rays, std::size_t i, const Corners& cell) {
  Doubles t_enter = load(rays.t_begin + i);
  Doubles t_exit = load(rays.t_end + i);
  for (int axis = 0; axis < 3; ++axis) {
    const Doubles origin = load(rays.origin[axis] + i);
    const Doubles inverse = load(rays.inverse[axis] + i);
    const Doubles a = (cell.first[axis] - origin) * inverse;
    const Doubles b = ((cell.first[axis] + 1.0) - origin) * inverse;
    if (kSlack) {
      const Doubles slack = load(rays.slack[axis] + i);
      t_enter = greatest(t_enter, least(a, b) - slack);
      t_exit = least(t_exit, greatest(a, b) + slack);
    } else {
      t_enter = greatest(t_enter, least(a, b));
      t_exit = least(t_exit, greatest(a, b));
    }
  }
  return {t_enter, t_exit, t_enter < t_exit};
}

/// Bernstein coefficients of the field, as `cubic_along` (trilinear_line.h), operation by
/// operation.
struct Cubics {
  Doubles b[4];
};

inline Doubles point(const LaneRays& rays, std::size_t i, int axis, const Doubles& t,
                     const Corners& cell) {
  const Doubles p =
      (load(rays.origin[axis] + i) + t * load(rays.direction[axis] + i)) - cell.first[axis];
  const Doubles zero = p - p;
  return least(greatest(p, zero), zero + 1.0);
}

inline Cubics cubics(const LaneRays& rays, std::size_t i, const Passage& passage,
                     const Corners& cell) {
  const double* c = cell.at;
  const Doubles px = point(rays, i, 0, passage.t_enter, cell);
  const Doubles qx = point(rays, i, 0, passage.t_exit, cell);
  Doubles at_px[4];
  Doubles at_qx[4];
  for (std::size_t yz = 0; yz < 4; ++yz) {
    at_px[yz] = mix(c[2 * yz], c[2 * yz + 1], px);
    at_qx[yz] = mix(c[2 * yz], c[2 * yz + 1], qx);
  }
  const Doubles py = point(rays, i, 1, passage.t_enter, cell);
  const Doubles qy = point(rays, i, 1, passage.t_exit, cell);
  const Doubles pp0 = mix(at_px[0], at_px[1], py);
  const Doubles pp1 = mix(at_px[2], at_px[3], py);
  const Doubles pq0 = mix(at_px[0], at_px[1], qy);
  const Doubles pq1 = mix(at_px[2], at_px[3], qy);
  const Doubles qp0 = mix(at_qx[0], at_qx[1], py);
  const Doubles qp1 = mix(at_qx[2], at_qx[3], py);
  const Doubles qq0 = mix(at_qx[0], at_qx[1], qy);
  const Doubles qq1 = mix(at_qx[2], at_qx[3], qy);
  const Doubles pz = point(rays, i, 2, passage.t_enter, cell);
  const Doubles qz = point(rays, i, 2, passage.t_exit, cell);
  const Doubles ppq = mix(pp0, pp1, qz);
  const Doubles pqp = mix(pq0, pq1, pz);
  const Doubles pqq = mix(pq0, pq1, qz);
  const Doubles qpp = mix(qp0, qp1, pz);
  const Doubles qpq = mix(qp0, qp1, qz);
  const Doubles qqp = mix(qq0, qq1, pz);
  constexpr double kThird = 1.0 / 3.0;
  return {{mix(pp0, pp1, pz), qpp + ((pqp - qpp) + (ppq - qpp)) * kThird,
           pqq + ((qpq - pqq) + (qqp - pqq)) * kThird, mix(qq0, qq1, qz)}};
}

inline CellPart part_of(const Cubics& f, const Passage& passage, int lane) {
  return {{f.b[0][lane], f.b[1][lane], f.b[2][lane], f.b[3][lane]},
          passage.t_enter[lane],
          passage.t_exit[lane]};
}

/// Calls `on_rays(i, passage, cubics, mask)` for the vectors of rays of which some pass the cell
/// and are not beyond it.
template <bool kSlack, class OnRays>
inline void for_rays(const LaneRays& rays, const BrickSamples& brick, const BrickCell& cell,
                     const LaneRectangle& rectangle, const OnRays& on_rays) {
  const Corners corners = corners_of(brick, cell);
  for (int y = rectangle.y0; y < rectangle.y1; ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * rays.stride;
    for (int x = rectangle.x0; x < rectangle.x1; x += kLanes) {
      const std::size_t i = row + static_cast<std::size_t>(x);
      const Mask open = load(rays.best + i) < cell.greatest;
      if (bits(open) == 0) continue;
      const Passage passage = pass<kSlack>(rays, i, corners);
      const Mask mask = passage.inside & open;
      if (bits(mask) == 0) continue;
      on_rays(i, passage, cubics(rays, i, passage, corners), mask);
    }
  }
}

template <bool kSlack>
void raise(const LaneRays& rays, const BrickSamples& brick, const BrickCell& cell,
           const LaneRectangle& rectangle) {
  for_rays<kSlack>(rays, brick, cell, rectangle,
                   [&](std::size_t i, const Passage& passage, const Cubics& f, const Mask& mask) {
                     const Doubles before = load(rays.best + i);
                     const Doubles ends = greatest(f.b[0], f.b[3]);
                     const Mask raised = mask & (ends > before);
                     const Doubles best = raised ? ends : before;
                     if (bits(raised) != 0) store(rays.best + i, best);
                     // Between the ends the field stays below its greatest coefficient.
                     unsigned inner = bits(mask & (greatest(f.b[1], f.b[2]) > best));
                     for (; inner != 0; inner &= inner - 1) {
                       const int lane = __builtin_ctz(inner);
                       const double seen = maximum_of(part_of(f, passage, lane));
                       double& ray = rays.best[i + static_cast<std::size_t>(lane)];
                       if (seen > ray) ray = seen;
                     }
                   });
}

/// T, as `EmissionMap` has it.
inline Doubles emission_of(const MapEnds& map, const Doubles& value) {
  const Doubles zero = value - value;
  const Doubles bottom = zero + map.bottom;
  const Doubles top = zero + map.top;
  const Doubles s = (value - map.lo) / map.width;
  const Doubles between = least(greatest(map.bottom * (1.0 - s) + map.top * s, bottom), top);
  const Doubles risen = value >= map.hi ? top : between;
  return value > map.lo ? risen : bottom;
}

/// The cue at both ends of a part.
struct EndCues {
  Doubles enter;
  Doubles exit;
};

inline EndCues cues_of(const LaneRays& rays, std::size_t i, const Passage& passage) {
  const Doubles at = load(rays.beta_at + i);
  const Doubles rise = load(rays.beta_rise + i);
  const Doubles none = at - at;
  return {greatest(at + rise * passage.t_enter, none), greatest(at + rise * passage.t_exit, none)};
}

/// Raises `best` to what the ends of the parts show, and returns it.
inline Doubles raise_to_ends(const LaneRays& rays, std::size_t i, const Cubics& f,
                             const EndCues& beta, const MapEnds& map, const Mask& mask) {
  const Doubles before = load(rays.best + i);
  const Doubles ends =
      greatest(beta.enter * emission_of(map, f.b[0]), beta.exit * emission_of(map, f.b[3]));
  const Mask raised = mask & (ends > before);
  const Doubles best = raised ? ends : before;
  if (bits(raised) != 0) store(rays.best + i, best);
  return best;
}

/// Bernstein coefficients of bound times cue, as `product` (quartic.h).
struct Quartics {
  Doubles c[5];
};

inline Quartics bounds_of(const Cubics& f, const EndCues& beta, const EmissionBound& bound) {
  const Doubles b0 = bound.at_0 + bound.slope * f.b[0];
  const Doubles b1 = bound.at_0 + bound.slope * f.b[1];
  const Doubles b2 = bound.at_0 + bound.slope * f.b[2];
  const Doubles b3 = bound.at_0 + bound.slope * f.b[3];
  return {{beta.enter * b0, 0.25 * (beta.exit * b0) + 0.75 * (beta.enter * b1),
           0.5 * (beta.exit * b1 + beta.enter * b2),
           0.75 * (beta.exit * b2) + 0.25 * (beta.enter * b3), beta.exit * b3}};
}

/// A coefficient that is no number is not below.
inline Mask inner_stay_below(const Quartics& q, const Doubles& best) {
  return (q.c[1] <= best) & (q.c[2] <= best) & (q.c[3] <= best);
}
inline Mask ends_stay_below(const Quartics& q, const Doubles& best) {
  return (q.c[0] <= best) & (q.c[4] <= best);
}

/// The same of both halves, which tell more (de Casteljau); their outer ends do not count.
inline Mask halves_stay_below(const Quartics& q, const Doubles& best) {
  Doubles c[5] = {q.c[0], q.c[1], q.c[2], q.c[3], q.c[4]};
  Mask below = best == best;
  for (int size = 4; size > 0; --size) {
    for (int i = 0; i < size; ++i) c[i] = 0.5 * (c[i] + c[i + 1]);
    below &= (c[0] <= best) & (c[size - 1] <= best);
  }
  return below;
}

template <bool kSlack>
void visit_each(const LaneRays& rays, const BrickSamples& brick, const BrickCell& cell,
                const LaneRectangle& rectangle, const EmissionBound& bound, const MapEnds& map,
                const PartVisitor& visitor) {
  for_rays<kSlack>(
      rays, brick, cell, rectangle,
      [&](std::size_t i, const Passage& passage, const Cubics& f, const Mask& mask) {
        const EndCues beta = cues_of(rays, i, passage);
        const Doubles most = greatest(beta.enter, beta.exit) * map.top;
        const Quartics q = bounds_of(f, beta, bound);
        Doubles best = load(rays.best + i);
        Mask brighter =
            mask & ~((most <= best) | (inner_stay_below(q, best) & ends_stay_below(q, best)));
        if (bits(brighter) == 0) return;
        if (map.is_one_piece) {
          best = raise_to_ends(rays, i, f, beta, map, brighter);
          // The ends are seen; but beyond the map's end the bound lies above it.
          const Mask ends = (greatest(f.b[0], f.b[3]) <= map.hi) | ends_stay_below(q, best);
          brighter &= ~((most <= best) | (inner_stay_below(q, best) & ends));
          if (bits(brighter) == 0) return;
          brighter &= ~(halves_stay_below(q, best) & ends);
        }
        for (unsigned left = bits(brighter); left != 0; left &= left - 1) {
          const int lane = __builtin_ctz(left);
          visitor.visit(visitor.context, i + static_cast<std::size_t>(lane),
                        part_of(f, passage, lane));
        }
      });
}

double least_best(const LaneRays& rays, const LaneRectangle& rectangle) {
  Doubles result = Doubles{} + __builtin_inf();
  for (int y = rectangle.y0; y < rectangle.y1; ++y) {
    const double* row = rays.best + static_cast<std::size_t>(y) * rays.stride;
    int x = rectangle.x0;
    for (; x + kLanes <= rectangle.x1; x += kLanes) result = least(result, load(row + x));
    for (; x < rectangle.x1; ++x) result = least(result, Doubles{} + row[x]);
  }
  double least_lane = result[0];
  for (int lane = 1; lane < kLanes; ++lane) {
    least_lane = result[lane] < least_lane ? result[lane] : least_lane;
  }
  return least_lane;
}

unsigned long long greatest_corners(const BrickSamples& brick, double floor,
                                    double greatest_of[64]) {
  constexpr int kSide = BrickSamples::kCells;
  constexpr int kPlane = kSamples * kSamples;
  unsigned long long above = 0;
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; x += kLanes) {
        const double* base = brick.sample + sample_at(x, y, z);
        const auto pair = [&](int offset) {
          return greatest(load(base + offset), load(base + offset + 1));
        };
        const Doubles most = greatest(greatest(pair(0), pair(kSamples)),
                                      greatest(pair(kPlane), pair(kPlane + kSamples)));
        const int cell = x + kSide * (y + kSide * z);
        store(greatest_of + cell, most);
        above |= static_cast<unsigned long long>(bits(most > floor)) << cell;
      }
    }
  }
  return above;
}

void raise_maxima(const LaneRays& rays, const BrickSamples& brick, const BrickCell& cell,
                  const LaneRectangle& rectangle) {
  (rays.slack[0] != nullptr ? raise<true> : raise<false>)(rays, brick, cell, rectangle);
}

void visit_parts(const LaneRays& rays, const BrickSamples& brick, const BrickCell& cell,
                 const LaneRectangle& rectangle, const EmissionBound& bound, const MapEnds& map,
                 const PartVisitor& visitor) {
  (rays.slack[0] != nullptr ? visit_each<true> : visit_each<false>)(rays, brick, cell, rectangle,
                                                                    bound, map, visitor);
}

}  // namespace

CellKernel cell_kernel() noexcept {
  return {least_best, greatest_corners, raise_maxima, visit_parts};
}

}  // namespace nacre::NACRE_KERNEL
// NOLINTEND(modernize-avoid-c-arrays)
