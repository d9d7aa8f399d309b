// The kernel's one source, included once for each instruction set with NACRE_KERNEL (a namespace)
// and NACRE_VECTOR_BYTES defined. No inline function from elsewhere: see sample_kernel.h.
// NOLINTBEGIN(modernize-avoid-c-arrays)

namespace nacre::NACRE_KERNEL {
namespace {

constexpr int kLanes = NACRE_VECTOR_BYTES / 4;
constexpr int kSide = CastBrick::kSamples;
constexpr int kRow = 32;  // the samples of a plane, u fastest, and padding
constexpr int kMostPlanes = 4 * kMostSamplesPerCell + 1;
static_assert(BlockRays::kRays % kLanes == 0 && kRow % kLanes == 0);

using Floats [[gnu::vector_size(NACRE_VECTOR_BYTES)]] = float;
using Ints [[gnu::vector_size(NACRE_VECTOR_BYTES)]] = std::int32_t;

inline Floats load(const float* from) {
  Floats vector;
  __builtin_memcpy(&vector, from, sizeof vector);
  return vector;
}

inline void store(float* to, const Floats& vector) { __builtin_memcpy(to, &vector, sizeof vector); }

using Quad [[gnu::vector_size(16)]] = float;

template <class Vector>
inline Vector greatest(const Vector& a, const Vector& b) {
  return a > b ? a : b;
}
template <class Vector>
inline Vector least(const Vector& a, const Vector& b) {
  return a < b ? a : b;
}

/// All lanes joined by the least or the greatest, four at a time.
template <class Join>
inline float joined(const Floats& v, const Join& join) {
  Quad quads[kLanes / 4];
  __builtin_memcpy(quads, &v, sizeof v);
  for (int half = kLanes / 8; half > 0; half /= 2) {
    for (int i = 0; i < half; ++i) join(quads[i], quads[i + half]);
  }
  Quad all = quads[0];
  join(all, Quad{all[2], all[3], all[0], all[1]});
  join(all, Quad{all[1], all[0], all[3], all[2]});
  return all[0];
}

inline float greatest_lane(const Floats& v) {
  return joined(v, [](Quad& a, const Quad& b) { a = greatest(a, b); });
}

inline float least_lane(const Floats& v) {
  return joined(v, [](Quad& a, const Quad& b) { a = least(a, b); });
}

inline bool any(const Ints& mask) {
#if NACRE_VECTOR_BYTES == 64
  return __builtin_ia32_cvtd2mask512(mask) != 0;
#elif NACRE_VECTOR_BYTES == 32
  return __builtin_ia32_movmskps256(__builtin_bit_cast(Floats, mask)) != 0;
#elif defined(__SSE2__)
  return __builtin_ia32_movmskps(__builtin_bit_cast(Floats, mask)) != 0;
#else
  std::int32_t result = 0;
  for (int lane = 0; lane < kLanes; ++lane) result |= mask[lane];
  return result != 0;
#endif
}

inline Floats mix(const Floats& a, const Floats& b, const Floats& s) { return a + (b - a) * s; }

/// Samples of a plane at places below 32 of it.
inline Floats look_up(const float* plane, const Ints& at) {
#if NACRE_VECTOR_BYTES == 64
  return __builtin_shuffle(load(plane), load(plane + kLanes), at);
#elif NACRE_VECTOR_BYTES == 32
  // Four permutations and three choices: half the time of looking up lane by lane.
  Floats found[4];
  for (int i = 0; i < 4; ++i) found[i] = __builtin_shuffle(load(plane + kLanes * i), at);
  const Ints odd = (at & 8) != 0;
  const Floats lower = odd ? found[1] : found[0];
  const Floats upper = odd ? found[3] : found[2];
  return (at & 16) != 0 ? upper : lower;
#else
  Floats found;
  for (int lane = 0; lane < kLanes; ++lane) found[lane] = plane[at[lane]];
  return found;
#endif
}

/// A brick's samples on all sampled planes.
struct Planes {
  alignas(64) float voxels[kSide][kRow];
  alignas(64) float between[kMostPlanes][kRow];
  alignas(64) float face[CastBrick::kFaces][kRow];
  const float* sample[kMostPlanes];  ///< one or the other
  float greatest[kMostPlanes];       ///< what a ray can see of each
};

inline void copy_voxels(const CastBrick& brick, Planes& planes) {
  const int across = brick.step[0];
  for (int p = 0; p < kSide; ++p) {
    float* out = planes.voxels[p];
    for (int v = 0; v < kSide; ++v) {
      const float* row = brick.samples + p * brick.step[2] + v * brick.step[1];
      if (across == 1) {
        __builtin_memcpy(out + v * kSide, row, kSide * sizeof(float));
      } else {
        for (int u = 0; u < kSide; ++u) out[v * kSide + u] = row[u * across];
      }
    }
    for (int i = kSide * kSide; i < kRow; ++i) out[i] = out[0];
  }
}

/// Samples of a face of the border: along it, then across planes.
inline void copy_face(const CastBrick& brick, int face, float* out) {
  const int axis = face < 2 ? 0 : 1;
  const int cells = face % 2 == 0 ? 0 : static_cast<int>(brick.extent[axis]);
  const float* first = brick.samples + cells * brick.step[axis];
  for (int p = 0; p < kSide; ++p) {
    for (int along = 0; along < kSide; ++along) {
      out[p * kSide + along] = first[p * brick.step[2] + along * brick.step[1 - axis]];
    }
  }
  for (int i = kSide * kSide; i < kRow; ++i) out[i] = out[0];
}

inline float greatest_of_plane(const float* plane) {
  Floats most = load(plane);
  for (int i = kLanes; i < kRow; i += kLanes) most = greatest(most, load(plane + i));
  return greatest_lane(most);
}

inline void fill(const CastBrick& brick, const CastCue* cue, Planes& planes) {
  copy_voxels(brick, planes);
  for (int face = 0; face < CastBrick::kFaces; ++face) {
    if ((brick.faces >> face & 1U) != 0) copy_face(brick, face, planes.face[face]);
  }
  const float step = 1.0F / static_cast<float>(brick.per_cell);
  int cell = 0;
  int part = 0;
  for (int j = 0; j < brick.sampled; ++j) {
    planes.sample[j] = planes.voxels[cell];
    if (part != 0) {
      planes.sample[j] = planes.between[j];
      for (int i = 0; i < kRow; i += kLanes) {
        store(planes.between[j] + i,
              mix(load(planes.voxels[cell] + i), load(planes.voxels[cell + 1] + i),
                  Floats{} + static_cast<float>(part) * step));
      }
    }
    if (++part == brick.per_cell) {
      part = 0;
      ++cell;
    }
    float seen = greatest_of_plane(planes.sample[j]);
    if (cue != nullptr) {
      const float risen = seen > 0.0F ? seen : 0.0F;
      const float emission = cue->bottom + (risen < 1.0F ? risen : 1.0F) * (cue->top - cue->bottom);
      seen = emission * cue->greatest;
    }
    planes.greatest[j] = seen < brick.greatest ? seen : brick.greatest;
  }
}

/// What the rays of a vector meet: where in the brick, and which of them do.
struct Seen {
  Floats sample;
  Floats u;
  Floats v;
  Floats plane;  ///< of the volume
  Ints mask;
};

struct Lines {
  Floats u, v, du, dv;
};

/// So little beyond a brick's faces counts as inside, so that rays along the volume's border are.
/// (Between bricks none is lost: they work a place out alike.)
constexpr float kHair = 1e-5F;

inline Ints within(const Floats& place, float extent) {
  return (place >= -kHair) & (place <= extent + kHair);
}

/// Between four of a plane's samples.
inline Floats bilinear(const float* plane, const Floats& u, const Floats& v) {
  const Floats most = Floats{} + 3.0F;
  const Floats none = Floats{};
  const Ints iu = __builtin_convertvector(least(greatest(u, none), most), Ints);
  const Ints iv = __builtin_convertvector(least(greatest(v, none), most), Ints);
  const Floats su = u - __builtin_convertvector(iu, Floats);
  const Floats sv = v - __builtin_convertvector(iv, Floats);
  const Ints at = iu + iv * kSide;
  const Floats near = mix(look_up(plane, at), look_up(plane, at + 1), su);
  const Floats far = mix(look_up(plane, at + kSide), look_up(plane, at + (kSide + 1)), su);
  return mix(near, far, sv);
}

inline void cross_plane(const Lines& lines, const CastBrick& brick, const Planes& planes, int j,
                        float p, Seen& seen) {
  seen.plane = Floats{} + p;
  seen.u = (lines.u + seen.plane * lines.du) - brick.first[0];
  seen.v = (lines.v + seen.plane * lines.dv) - brick.first[1];
  seen.mask = within(seen.u, brick.extent[0]) & within(seen.v, brick.extent[1]);
  if (kLanes < BlockRays::kRays && !any(seen.mask)) return;
  seen.sample = bilinear(planes.sample[j], seen.u, seen.v);
}

/// Where rays go through a face of the volume's border, which may lie between planes.
inline void cross_face(const Lines& lines, const CastBrick& brick, const Planes& planes, int face,
                       Seen& seen) {
  const bool of_u = face < 2;
  const int axis = of_u ? 0 : 1;
  const float place = face % 2 == 0 ? 0.0F : brick.extent[axis];
  const Floats way = (brick.first[axis] + place) - (of_u ? lines.u : lines.v);
  seen.plane = way / (of_u ? lines.du : lines.dv);  // no number: not within
  const Floats p = seen.plane - brick.first[2];
  const Floats there = Floats{} + place;
  seen.u = of_u ? there : (lines.u + seen.plane * lines.du) - brick.first[0];
  seen.v = of_u ? (lines.v + seen.plane * lines.dv) - brick.first[1] : there;
  const Floats& along = of_u ? seen.v : seen.u;
  seen.mask = within(along, brick.extent[of_u ? 1 : 0]) & within(p, brick.extent[2]);
  seen.sample = bilinear(planes.face[face], along, p);
}

/// Between eight of a brick's samples.
inline float trilinear(const CastBrick& brick, const float place[3]) {
  const float* first = brick.samples;
  float s[3];
  for (int axis = 0; axis < 3; ++axis) {
    const float most = static_cast<float>(kSide - 2);
    const float inside = place[axis] > 0.0F ? place[axis] : 0.0F;
    const int cell = static_cast<int>(inside < most ? inside : most);
    first += cell * brick.step[axis];
    s[axis] = place[axis] - static_cast<float>(cell);
  }
  const auto along = [&](const float* from) {
    return from[0] + (from[brick.step[0]] - from[0]) * s[0];
  };
  const auto across = [&](const float* from) {
    const float near = along(from);
    return near + (along(from + brick.step[1]) - near) * s[1];
  };
  const float near = across(first);
  return near + (across(first + brick.step[2]) - near) * s[2];
}

/// Where rays are cut off, between planes.
inline void meet_end(const Lines& lines, const CastBrick& brick, const Floats& plane, Seen& seen) {
  seen.plane = plane;
  seen.u = (lines.u + plane * lines.du) - brick.first[0];
  seen.v = (lines.v + plane * lines.dv) - brick.first[1];
  const Floats p = plane - brick.first[2];
  seen.mask = within(seen.u, brick.extent[0]) & within(seen.v, brick.extent[1]) &
              within(p, brick.extent[2]);
  seen.sample = Floats{};
  if (!any(seen.mask)) return;
  for (int lane = 0; lane < kLanes; ++lane) {
    if (seen.mask[lane] == 0) continue;
    const float place[3] = {seen.u[lane], seen.v[lane], p[lane]};
    seen.sample[lane] = trilinear(brick, place);
  }
}

template <class OnSeen>
inline void for_samples(const BlockRays& rays, const CastBrick& brick,
                        const BlockRectangle& rectangle, const CastCue* cue,
                        const OnSeen& on_seen) {
  Planes planes;
  bool filled = false;
  const float step = 1.0F / static_cast<float>(brick.per_cell);
  for (int y = rectangle.y0; y < rectangle.y1; ++y) {
    for (int x = rectangle.x0; x < rectangle.x1; ++x) {
      const int block = (y * BlockRays::kBlocks + x) * BlockRays::kRays;
      for (int i = block; i < block + BlockRays::kRays; i += kLanes) {
        Floats best = load(rays.best + i);
        if (!any(best < brick.greatest)) continue;
        if (!filled) fill(brick, cue, planes);
        filled = true;
        const Lines lines{load(rays.u + i), load(rays.v + i), load(rays.du + i), load(rays.dv + i)};
        Seen seen{};
        const auto raise_best = [&](float most) {
          if (rays.first_plane != nullptr) {
            seen.mask &= (seen.plane >= load(rays.first_plane + i)) &
                         (seen.plane <= load(rays.last_plane + i));
          }
          Floats shown = seen.sample;
          on_seen(seen, shown);
          shown = least(shown, Floats{} + most);
          best = (seen.mask & (shown > best)) ? shown : best;
        };
        for (int j = 0; j < brick.sampled; ++j) {
          if (!any(best < planes.greatest[j])) continue;
          const float p = brick.first[2] + static_cast<float>(j) * step;
          cross_plane(lines, brick, planes, j, p, seen);
          raise_best(planes.greatest[j]);
        }
        for (int face = 0; face < CastBrick::kFaces; ++face) {
          if ((brick.faces >> face & 1U) == 0) continue;
          cross_face(lines, brick, planes, face, seen);
          raise_best(brick.greatest);
        }
        if (rays.first_plane != nullptr) {
          meet_end(lines, brick, load(rays.first_plane + i), seen);
          raise_best(brick.greatest);
          meet_end(lines, brick, load(rays.last_plane + i), seen);
          raise_best(brick.greatest);
        }
        store(rays.best + i, best);
      }
    }
  }
}

void raise(const BlockRays& rays, const CastBrick& brick, const BlockRectangle& rectangle,
           const CastCue* cue) {
  if (cue == nullptr) {
    for_samples(rays, brick, rectangle, cue, [](const Seen&, Floats&) {});
    return;
  }
  for_samples(rays, brick, rectangle, cue, [&](const Seen& seen, Floats& shown) {
    const Floats none{};
    const Floats part = least(greatest(seen.sample, none), none + 1.0F);
    const Floats emission = cue->bottom + part * (cue->top - cue->bottom);
    const Floats beta = cue->at_corner + (cue->rise[0] * seen.u + cue->rise[1] * seen.v +
                                          cue->rise[2] * (seen.plane - brick.first[2]));
    shown = emission * greatest(beta, none);
  });
}

float least_best(const BlockRays& rays, const BlockRectangle& rectangle) {
  Floats result = Floats{} + __builtin_inff();
  for (int y = rectangle.y0; y < rectangle.y1; ++y) {
    const int row = y * BlockRays::kBlocks;
    for (int i = (row + rectangle.x0) * BlockRays::kRays;
         i < (row + rectangle.x1) * BlockRays::kRays; i += kLanes) {
      result = least(result, load(rays.best + i));
    }
  }
  return least_lane(result);
}

}  // namespace

SampleKernel sample_kernel() noexcept { return {raise, least_best}; }

}  // namespace nacre::NACRE_KERNEL
// NOLINTEND(modernize-avoid-c-arrays)
