#include "shells/simplify.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <queue>
#include <vector>

#include "shells/closed_mesh.h"
#include "shells/distance_budget.h"
#include "shells/field_quadrics.h"
#include "shells/grid_fit.h"
#include "shells/star.h"
#include "shells/star_fit.h"

namespace nacre {
namespace {

// Root mean square of the quadric's error, as a part of the tolerance. What it refuses would mostly
// fail at the samples, and what would not costs more of the picture than it saves.
constexpr double kMeanPart = 0.7;
constexpr int kFitRounds = 2;
constexpr double kNoStep = 0.01;  // of the spacing: not worth another round
constexpr double kReach = 0.5;    // likewise: no fit goes farther from where it starts

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// An edge to collapse, at its cost when its ends were as old as the stamp.
struct Candidate {
  float cost;
  std::uint32_t half_edge;
  std::uint32_t stamp;
};

struct Later {
  bool operator()(const Candidate& a, const Candidate& b) const noexcept {
    return a.cost != b.cost ? a.cost > b.cost : a.half_edge > b.half_edge;
  }
};

class EdgeCollapser {
 public:
  EdgeCollapser(const TriangleMesh& surface, const SimplifyOptions& options);

  /// Collapses edges, cheapest first, until none may go.
  void run();
  void settle_on_grid();
  TriangleMesh take() const { return live_surface(mesh_, positions_); }

 private:
  void measure();
  CollapseTarget target_of(std::uint32_t h) const { return quadrics_.target(mesh_, positions_, h); }
  bool is_hopeless(std::uint32_t h, const CollapseTarget& target) const;
  void push(std::uint32_t h);
  bool is_current(const Candidate& candidate) const;
  std::uint32_t stamp_of(std::uint32_t h) const {
    return std::max(changed_[mesh_.from(h)], changed_[mesh_.to(h)]);
  }
  void try_collapse(std::uint32_t h);
  void find_allowed();
  std::optional<glm::dvec3> place(const glm::dvec3& start);
  std::optional<glm::dvec3> fit_field(const glm::dvec3& start);
  void commit(std::uint32_t h, const glm::dvec3& p);

  const SimplifyOptions& options_;
  ClosedMesh mesh_;
  std::vector<glm::dvec3> positions_;
  FieldQuadrics quadrics_;
  bool is_bounded_;                     ///< by the field's error
  std::vector<float> face_error_;       ///< sampled, of each triangle as it is
  std::vector<float> vertex_error_;     ///< most that a triangle at each vertex has had
  std::vector<std::uint32_t> changed_;  ///< when each vertex changed last
  std::uint32_t clock_ = 0;
  DistanceBudget distance_;
  std::priority_queue<Candidate, std::vector<Candidate>, Later> queue_;
  std::size_t triangles_;

  // Of the collapse at hand.
  Star star_;
  StarFit fit_;
  std::vector<double> allowed_;  ///< error of each of the star's triangles
  std::vector<double> errors_;   ///< likewise, where it was placed
};

EdgeCollapser::EdgeCollapser(const TriangleMesh& surface, const SimplifyOptions& options)
    : options_(options),
      mesh_(surface.triangles, surface.positions.size()),
      positions_(positions_of(mesh_, surface)),
      quadrics_(mesh_, positions_, options.field, options.spacing_mm),
      // A target alone has no bound.
      is_bounded_(options.field &&
                  (options.error_tolerance > 0.0 || options.target_triangles == 0)),
      face_error_(is_bounded_ ? mesh_.triangle_count() : 0, 0.0f),
      vertex_error_(mesh_.vertex_count(), static_cast<float>(options.error_tolerance)),
      changed_(mesh_.vertex_count(), 0),
      distance_(options.tolerance_mm, mesh_.triangle_count()),
      triangles_(mesh_.triangle_count()),
      fit_(options.field, options.samples_from_mm, options.volume_weight) {
  if (is_bounded_) measure();
}

/// Samples the error of every triangle: its inside, its sides and its corners.
void EdgeCollapser::measure() {
  std::vector<float> at_vertex(positions_.size());
  std::transform(positions_.begin(), positions_.end(), at_vertex.begin(), [&](const glm::dvec3& p) {
    return static_cast<float>(std::abs(options_.field(p).error));
  });
  const glm::dmat3& samples = options_.samples_from_mm;
  for (std::uint32_t h = 0; h < mesh_.half_edge_count(); ++h) {
    float& error = face_error_[h / 3];
    const glm::dvec3& a = positions_[mesh_.from(h)];
    const glm::dvec3& b = positions_[mesh_.to(h)];
    error = std::max(error, at_vertex[mesh_.from(h)]);
    if (h % 3 == 0) {
      const double inner = inner_error(options_.field, samples, a, b, positions_[mesh_.apex(h)]);
      error = std::max(error, static_cast<float>(inner));
    }
    if (h > mesh_.opposite(h)) continue;
    const auto side = static_cast<float>(side_error(options_.field, samples, a, b));
    float& beyond = face_error_[mesh_.opposite(h) / 3];
    error = std::max(error, side);
    beyond = std::max(beyond, side);
  }
  for (std::uint32_t h = 0; h < mesh_.half_edge_count(); ++h) {
    float& error = vertex_error_[mesh_.from(h)];
    error = std::max(error, face_error_[h / 3]);
  }
}

/// Whether the quadric's error is too large to be worth sampling the field.
bool EdgeCollapser::is_hopeless(std::uint32_t h, const CollapseTarget& target) const {
  if (!is_bounded_) return false;
  const double most =
      kMeanPart * std::max(vertex_error_[mesh_.from(h)], vertex_error_[mesh_.to(h)]);
  return target.cost > most * most * target.area;
}

void EdgeCollapser::push(std::uint32_t h) {
  const CollapseTarget target = target_of(h);
  if (is_hopeless(h, target)) return;
  queue_.push({static_cast<float>(target.cost), std::min(h, mesh_.opposite(h)), stamp_of(h)});
}

bool EdgeCollapser::is_current(const Candidate& candidate) const {
  return mesh_.is_alive(candidate.half_edge / 3) &&
         stamp_of(candidate.half_edge) == candidate.stamp;
}

/// What each of the star's triangles may be off: the tolerance, or as much as it was.
void EdgeCollapser::find_allowed() {
  allowed_.clear();
  for (const StarTriangle& t : star_.triangles) {
    allowed_.push_back(is_bounded_ ? std::max(options_.error_tolerance, double{face_error_[t.face]})
                                   : kUnbounded);
  }
}

/// Where the apex follows the field best within what is allowed, from `start`.
std::optional<glm::dvec3> EdgeCollapser::fit_field(const glm::dvec3& start) {
  std::optional<glm::dvec3> best;
  double least = kUnbounded;
  glm::dvec3 p = start;
  for (int round = 0; round < kFitRounds; ++round) {
    if (!keeps_shape(star_, p) || !fit_.sample(star_, p, allowed_)) break;
    if (fit_.is_within() && fit_.sum_of_squares() < least) {
      best = p;
      least = fit_.sum_of_squares();
      errors_.assign(fit_.triangle_errors().begin(), fit_.triangle_errors().end());
    }
    const glm::dvec3 step = fit_.step();
    p += step;
    if (!(glm::length(step) > kNoStep * options_.spacing_mm) ||
        !(glm::distance(p, start) < kReach * options_.spacing_mm)) {
      break;
    }
  }
  return best;
}

std::optional<glm::dvec3> EdgeCollapser::place(const glm::dvec3& start) {
  std::optional<glm::dvec3> placed;
  if (options_.field) {
    placed = fit_field(start);
  } else if (keeps_shape(star_, start)) {
    placed = start;
  }
  return placed && distance_.allows(star_, *placed) ? placed : std::nullopt;
}

void EdgeCollapser::try_collapse(std::uint32_t h) {
  if (!mesh_.can_collapse(h)) return;
  star_of_collapse(mesh_, positions_, h, star_);
  find_allowed();
  const CollapseTarget target = target_of(h);
  // The ends come last: a cap's rim has to stay in its plane.
  for (const glm::dvec3& start :
       {target.point, positions_[mesh_.from(h)], positions_[mesh_.to(h)]}) {
    if (const auto p = place(start)) {
      commit(h, *p);
      return;
    }
  }
}

void EdgeCollapser::commit(std::uint32_t h, const glm::dvec3& p) {
  distance_.commit(star_, p);
  if (is_bounded_) {
    for (std::size_t i = 0; i < star_.triangles.size(); ++i) {
      face_error_[star_.triangles[i].face] = static_cast<float>(errors_[i]);
    }
  }
  const std::uint32_t u = mesh_.from(h);
  const std::uint32_t v = mesh_.to(h);
  vertex_error_[v] = std::max(vertex_error_[u], vertex_error_[v]);
  mesh_.collapse(h);
  triangles_ -= 2;
  positions_[v] = p;
  quadrics_.merge(u, v);
  changed_[v] = ++clock_;
  mesh_.for_each_outgoing(v, [&](std::uint32_t spoke) { push(spoke); });
}

void EdgeCollapser::run() {
  for (std::uint32_t h = 0; h < mesh_.half_edge_count(); ++h) {
    if (h < mesh_.opposite(h)) push(h);
  }
  while (!queue_.empty() && triangles_ > options_.target_triangles) {
    const Candidate cheapest = queue_.top();
    queue_.pop();
    if (is_current(cheapest)) try_collapse(cheapest.half_edge);
  }
}

void EdgeCollapser::settle_on_grid() {
  fit_to_grid(mesh_, options_.field, options_.samples_from_mm, *options_.grid, positions_,
              options_.volume_weight, options_.border);
}

}  // namespace

TriangleMesh simplify(const TriangleMesh& surface, const SimplifyOptions& options) {
  const bool is_bounded = options.tolerance_mm > 0.0 || options.field;
  const bool is_small = surface.triangles.size() <= options.target_triangles;
  if (surface.triangles.empty() || is_small || (!is_bounded && options.target_triangles == 0)) {
    return surface;
  }
  EdgeCollapser collapser(surface, options);
  collapser.run();
  if (options.field && options.grid) collapser.settle_on_grid();
  return collapser.take();
}

}  // namespace nacre
