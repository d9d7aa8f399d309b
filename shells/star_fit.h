#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shells/star.h"
#include "shells/surface_field.h"

namespace nacre {

/// How well a star with its apex at some point follows a field, and where its apex would follow it
/// better.
///
/// The error is sampled at the apex, along the spokes and within the triangles, a voxel apart and
/// at the middles at least; the ring's own sides stay what they are. A sample has the weight w of
/// the apex, so that moving this by d changes its error by w g.d to first order: the sum of squares
/// is least at (sum w^2 g g^T) d = - sum w e g (Gauss, Newton). The volume that the star gains or
/// loses against what it was counts as one more error, as strong as all samples or twice: where the
/// field is steeper outside than inside, as at a vessel's tip, least squares alone would make
/// shells shrink, step by step (Lindstrom, Turk 1998, "Fast and Memory Efficient Polygonal
/// Simplification").
class StarFit {
 public:
  static constexpr double kVolumeWeight = 2.0;

  /// @param field            may be empty: then nothing is ever wrong
  /// @param samples_from_mm  turns offsets into numbers of samples: voxels from mm
  /// @param volume_weight    of the volume, in samples as many as all
  StarFit(const SurfaceField& field, const glm::dmat3& samples_from_mm,
          double volume_weight = kVolumeWeight)
      : field_(field), samples_from_mm_(samples_from_mm), volume_weight_(volume_weight) {}

  /// Samples the star about p.
  /// @param allowed  largest |error| of each triangle
  /// @return false as soon as some sample is out of proportion (twice what is allowed)
  bool sample(const Star& star, const glm::dvec3& p, std::span<const double> allowed);

  /// Whether all samples were within what is allowed.
  bool is_within() const noexcept { return is_within_; }
  /// Whether a sample may not move: on a cap, or beside one.
  bool is_pinned() const noexcept { return is_pinned_; }
  double sum_of_squares() const noexcept { return squares_; }

  /// Largest |error| of each triangle sampled, its side of the ring left out.
  std::span<const double> triangle_errors() const noexcept { return triangle_errors_; }

  /// How the sum of squares changes if the apex moves by d, to second order.
  double change(const glm::dvec3& d) const noexcept;

  /// How the apex should move; directions along which nothing changes are left alone.
  glm::dvec3 step() const;

 private:
  void accumulate(double error, const glm::dvec3& g, double weight);
  void add_volume(const Star& star, const glm::dvec3& p);
  bool add(const glm::dvec3& p, double weight, double allowed, double& worst);
  bool sample_spoke(const glm::dvec3& p, const glm::dvec3& end, double allowed, double& worst);
  bool sample_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                       double allowed, double& worst);

  const SurfaceField& field_;
  glm::dmat3 samples_from_mm_;
  double volume_weight_;
  bool is_within_ = true;
  bool is_pinned_ = false;
  double squares_ = 0.0;
  std::size_t count_ = 0;
  glm::dvec3 diagonal_{0.0};  ///< of the normal equations: xx, yy, zz
  glm::dvec3 beside_{0.0};    ///< xy, xz, yz
  glm::dvec3 right_{0.0};
  std::vector<double> triangle_errors_;
  double squared_weights_ = 0.0;
};

/// Whether no |error| of a star with its apex at p is more than `allowed`, sampled as a fit's is.
bool stays_within(const Star& star, const glm::dvec3& p, const SurfaceField& field,
                  const glm::dmat3& samples_from_mm, double allowed);

/// Largest |error| strictly within a triangle, sampled like a star's.
double inner_error(const SurfaceField& field, const glm::dmat3& samples_from_mm,
                   const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// Largest |error| strictly between the ends of a side, likewise.
double side_error(const SurfaceField& field, const glm::dmat3& samples_from_mm, const glm::dvec3& a,
                  const glm::dvec3& b);

}  // namespace nacre
