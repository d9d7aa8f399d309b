#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "core/progress.h"
#include "core/volume.h"

namespace nacre {

/// What the angiogram's scanner saw: all in LPS mm and in the volume's values.
struct AngiogramOptions {
  glm::i64vec3 size{256, 256, 124};
  std::uint64_t seed = 1;
  double noise = 20.0;  ///< standard deviation of each channel; 0 for none
};

/// Field of view, mm: 0.7 x 0.7 x 0.8 mm a voxel by default.
inline constexpr glm::dvec3 kAngiogramExtentMm{179.2, 179.2, 99.2};

/// Width of the scanner's point spread, the standard deviation of a Gaussian, in mean voxel edges.
inline constexpr double kPointSpreadVoxels = 0.45;

/// A magnetic resonance angiogram of the arteries of make_cerebral_arteries(), in a head's tissue:
/// i16, 0 to 4095.
///
///     sample = round(|g(p) max(tissue, max_i(tissue + (b_i - tissue) c_i)) + n_1 + i n_2|)
///
/// with the vessels' brightness b (narrower vessels flow more slowly and are less bright), their
/// coverage c of the point spread (vessel_coverage), the receiving coil's gain g, and independent
/// normal noise n_1, n_2 in the two channels: Rician magnitudes (rician_magnitude).
///
/// @throws Error  BadArgument for a dimension below 1
Volume make_angiogram(const AngiogramOptions& options, const ProgressCallback& progress = {});

/// How much of a Gaussian point spread lies in a vessel: 1 inside a thick one, less near its wall
/// and in thin ones.
///
///     c = (1 - e^(-r^2 / 2 s^2)) / erf(r / sqrt(2) s)
///         * (erf((r - d) / sqrt(2) s) + erf((r + d) / sqrt(2) s)) / 2
///
/// (docs/derivations.md, P7). Exact for a straight vessel on its axis (d = 0, the first factor
/// times erf: a disc under a Gaussian), in the limit of a thick one (a plane wall) and of a thin
/// one (a Gaussian line).
///
/// @param distance  d, from the axis
/// @param radius    r, positive
/// @param spread    s, standard deviation of the point spread, positive
double vessel_coverage(double distance, double radius, double spread);

/// Magnitude of a complex signal with independent normal noise in both channels,
/// sqrt((signal + n_1)^2 + n_2^2): Rice's distribution (Gudbjartsson and Patz 1995, "The Rician
/// distribution of noisy MRI data"), with E[m^2] = signal^2 + 2 sigma^2, and E[m] = sigma
/// sqrt(pi/2) where the signal is 0.
///
/// @param sigma    standard deviation of each channel
/// @param counter  the sample's index: the same one has the same noise
double rician_magnitude(double signal, double sigma, std::uint64_t seed, std::uint64_t counter);

}  // namespace nacre
