#pragma once

#include <glm/vec3.hpp>

namespace nacre {

/// `hipip`: a wave function like that of an iron protein's active site (the high potential iron
/// protein, HIPIP, of the volume rendering literature): a linear combination of atomic orbitals
///
///     psi(p) = sum_i c_i Y_i(u / rho_i) exp(-|u| / rho_i),    u = p - a_i,
///
/// with Y = 1 (s), d.u (p along d) or 3 (d.u)^2 - |u|^2 (d along d), on iron and sulfur atoms that
/// are symmetric about the planes x = 0 and y = 0. Positive and negative lobes of about equal
/// volume; scaled and cut to [-255, 255], as the published set is.
///
/// @param p_mm  LPS mm; the set spans 64 mm about the origin
double hipip_value(const glm::dvec3& p_mm);

/// `plume`: a contaminant that two wells release into ground water which flows along +z: an exact
/// solution of the advection-dispersion equation
///
///     dC/dt + v dC/dz = D_L d^2C/dz^2 + D_T (d^2C/dx^2 + d^2C/dy^2),
///
/// the sum of Gaussian puffs given off at equal intervals (Bear 1972, "Dynamics of Fluids in Porous
/// Media", chapter 10; docs/derivations.md, P9). A model tank of 210 x 210 x 510 mm about the
/// origin, in which z is the long axis.
struct PlumeField {
  double velocity_mm_s = 1.0;       ///< v
  double along_mm2_s = 4.0;         ///< D_L
  double across_mm2_s = 1.2;        ///< D_T
  double release_s = 330.0;         ///< from the first puff to the last
  double last_release_age_s = 0.0;  ///< time since the last puff

  /// Concentration, mg/l, nowhere negative.
  double value(const glm::dvec3& p_mm) const;
};

}  // namespace nacre
