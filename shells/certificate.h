#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <span>
#include <vector>

#include "core/camera.h"
#include "core/dequantization.h"
#include "core/emission.h"
#include "core/progress.h"
#include "core/shell_set.h"
#include "core/volume.h"

namespace nacre {

/// A direction that pictures are measured from, as the command's camera flags say it.
struct CertificateView {
  NamedView view = NamedView::Anterior;
  double azimuth_deg = 0.0;
  double elevation_deg = 0.0;
};

/// Along the patient's axes (seen from behind, pictures are the same) and the four diagonals
/// between them.
std::vector<CertificateView> certificate_views();

struct CertificateOptions {
  glm::ivec2 size{512, 512};  ///< of each picture, pixels
  std::vector<CertificateView> views = certificate_views();
  bool maxima_only = false;        ///< neither sums nor surfaces are measured: their errors stay 0
  ProgressCallback progress = {};  ///< stages "exact pictures" and "certificate"
};

/// How far pictures of the shells are from the exact projections of the volume; lit: over the
/// pixels where those show anything (> 0).
struct CertifiedError {
  double peak = 1.0;  ///< what PSNR is against: 1 for max, the largest exact pixel for sum
  double rmse = 0.0;  ///< emission for max, emission * mm for sum
  double rmse_lit = 0.0;
  double psnr_db = 0.0;  ///< infinite where rmse is 0
  double psnr_lit_db = 0.0;
  double max_error = 0.0;
};

struct CertifiedView {
  CertificateView view;
  CertifiedError max;
  CertifiedError sum;
  CertifiedError max_fine;
};

/// What a shell set's pictures and surfaces are worth.
struct Certificate {
  glm::ivec2 size{0};
  std::vector<CertifiedView> views;
  CertifiedError max;  ///< over all views' pixels
  CertifiedError sum;
  /// Of maxima that are estimated between the levels, as the command shows them (`dequantize`).
  CertifiedError max_fine;
  /// |phi - t_k| over the surfaces (`SurfaceEmission`): the largest sample, the root mean square
  /// over the area of all shells, and a bound that no point exceeds.
  double max_emission_error = 0.0;
  double rms_emission_error = 0.0;
  double emission_error_bound = 0.0;
};

/// Measures a shell set's error, some shells at a time: exact pictures of the volume
/// (`exact_picture`) beside exact pictures of the shells' triangles (`shell_picture`), both by rays
/// in double, orthographic, uncued and without a slab; and the surfaces beside the field.
///
/// A maximum is the largest of what parts of a set show, a sum their sum, so that never more than
/// some of the shells need be in memory. Nothing is drawn: the same input gives the same figures on
/// every machine, for any number of threads.
class Certifier {
 public:
  /// Makes the exact pictures.
  /// @param volume, emission  what the set was made from; must outlive this
  /// @throws Error            BadArgument for a size out of range or without any view
  Certifier(const Volume& volume, const EmissionMap& emission,
            const CertificateOptions& options = {});
  ~Certifier();
  Certifier(const Certifier&) = delete;
  Certifier& operator=(const Certifier&) = delete;

  /// Takes the next shells, from the outermost inwards; empty ones, too.
  /// @param set  the centre and the grid of their positions; its shells are not looked at
  void add(const ShellSet& set, std::vector<Shell>&& shells);

  /// Forgets the shells taken, for those of another set of the volume; the exact pictures stay.
  void restart();

  Certificate result() const;

 private:
  class Pictures;
  struct Emissions;

  const Volume& volume_;
  const EmissionMap& emission_;
  CertificateOptions options_;
  std::vector<Pictures> pictures_;  ///< of each view
  std::unique_ptr<Emissions> emissions_;
  double summed_below_ = 0.0;       ///< what sums show for the last shell's layer
  std::vector<LayerLevel> levels_;  ///< of the shells taken
};

/// The certificate of a set in memory.
Certificate certify(const ShellSet& set, const Volume& volume, const EmissionMap& emission,
                    const CertificateOptions& options = {});

}  // namespace nacre
