#include "shells/coarsen.h"

#include <array>
#include <cstdint>
#include <vector>

#include "shells/closed_mesh.h"
#include "shells/field_quadrics.h"
#include "shells/star.h"
#include "shells/star_fit.h"

namespace nacre {
namespace {

// Root mean square of a quadric's error, as a part of the tolerance: in the last pass, and of that
// in each. The first take what is cheap everywhere before anything dear is taken anywhere; more of
// them gain 0.1 dB of a maximum and take a tenth more time.
constexpr double kMeanPart = 0.7;
constexpr std::array kPasses{0.2, 0.4, 0.7, 1.0};

class Coarsener {
 public:
  Coarsener(const TriangleMesh& surface, const SurfaceField& field, const CoarsenOptions& options)
      : field_(field),
        options_(options),
        mesh_(surface.triangles, surface.positions.size()),
        positions_(positions_of(mesh_, surface)),
        quadrics_(mesh_, positions_, field, options.spacing_mm) {}

  /// Collapses each edge, in their order, whose mean error stays below `most`.
  void pass(double most);

  TriangleMesh take() const { return live_surface(mesh_, positions_); }

 private:
  void try_collapse(std::uint32_t h, double most);

  const SurfaceField& field_;
  const CoarsenOptions& options_;
  ClosedMesh mesh_;
  std::vector<glm::dvec3> positions_;
  FieldQuadrics quadrics_;
  Star star_;  ///< of the collapse at hand
};

void Coarsener::try_collapse(std::uint32_t h, double most) {
  const CollapseTarget target = quadrics_.target(mesh_, positions_, h);
  if (target.error > most * most * target.area || !mesh_.can_collapse(h)) return;
  star_of_collapse(mesh_, positions_, h, star_);
  if (!keeps_shape(star_, target.point) ||
      !stays_within(star_, target.point, field_, options_.samples_from_mm,
                    options_.error_tolerance)) {
    return;
  }
  const std::uint32_t u = mesh_.from(h);
  const std::uint32_t v = mesh_.to(h);
  mesh_.collapse(h);
  positions_[v] = target.point;
  quadrics_.merge(u, v);
}

void Coarsener::pass(double most) {
  for (std::uint32_t h = 0; h < mesh_.half_edge_count(); ++h) {
    if (mesh_.is_alive(h / 3) && h < mesh_.opposite(h)) try_collapse(h, most);
  }
}

}  // namespace

TriangleMesh coarsen(const TriangleMesh& surface, const SurfaceField& field,
                     const CoarsenOptions& options) {
  Coarsener coarsener(surface, field, options);
  for (const double part : kPasses) coarsener.pass(part * kMeanPart * options.error_tolerance);
  return coarsener.take();
}

}  // namespace nacre
