#include "app/set_certificate.h"

#include <fmt/core.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/error.h"
#include "io/draco_decode.h"
#include "shells/certificate.h"
#include "shells/voxel_checksum.h"

namespace nacre {
namespace {

using nlohmann::ordered_json;

// Shells are measured in parts of about so many triangles: some 70 MB with what rays need.
constexpr std::size_t kTrianglesAtOnce = std::size_t{1} << 20;

/// What is no measure, but noise of rounding, differs between mathematical libraries: five digits
/// are kept. JSON knows no infinity.
ordered_json rounded(double value) {
  if (!std::isfinite(value)) return {};
  return std::stod(fmt::format("{:.5g}", value));
}

ordered_json error_json(const CertifiedError& error) {
  return {{"psnr_db", rounded(error.psnr_db)},     {"psnr_lit_db", rounded(error.psnr_lit_db)},
          {"rmse", rounded(error.rmse)},           {"rmse_lit", rounded(error.rmse_lit)},
          {"max_error", rounded(error.max_error)}, {"peak", rounded(error.peak)}};
}

ordered_json decibels_json(const CertifiedError& error) {
  return {{"psnr_db", rounded(error.psnr_db)}, {"psnr_lit_db", rounded(error.psnr_lit_db)}};
}

ordered_json certificate_json(const Certificate& certificate) {
  ordered_json json;
  json["size"] = {certificate.size.x, certificate.size.y};
  json["max"] = error_json(certificate.max);
  json["max_fine"] = error_json(certificate.max_fine);
  json["sum"] = error_json(certificate.sum);
  json["surfaces"] = {{"max_error", rounded(certificate.max_emission_error)},
                      {"rms_error", rounded(certificate.rms_emission_error)},
                      {"error_bound", rounded(certificate.emission_error_bound)}};
  json["views"] = ordered_json::array();
  for (const CertifiedView& view : certificate.views) {
    json["views"].push_back({{"view", name(view.view.view)},
                             {"azimuth_deg", view.view.azimuth_deg},
                             {"elevation_deg", view.view.elevation_deg},
                             {"max", error_json(view.max)},
                             {"max_fine", decibels_json(view.max_fine)},
                             {"sum", error_json(view.sum)}});
  }
  return json;
}

void check_unchanged(const VolumeFlags& flags, const Volume& volume, const VolumeFacts& facts) {
  if (volume.dims == facts.dims && voxel_checksum(volume) == facts.checksum) return;
  throw Error(ErrorCode::BadFile,
              fmt::format("{}: found other samples than before, expected a file that does not "
                          "change while shells are built from it",
                          flags.path));
}

/// The error of a set's coarse copies, beside the exact pictures already made.
ordered_json coarse_error(const CompressedSet& built, const ProgressCallback& callback,
                          Certifier& certifier) {
  // A level without a copy is shown as it is.
  CompressedSet shown{built.set, built.shells};
  for (std::size_t k = 0; k < shown.shells.size(); ++k) {
    if (!built.coarse->shells[k].bytes.empty()) shown.shells[k] = built.coarse->shells[k];
  }
  certifier.restart();
  add_shells(shown, callback, certifier);
  const Certificate measured = certifier.result();
  const auto sized = [&](const CertifiedError& error) {
    ordered_json json = error_json(error);
    json["size"] = {measured.size.x, measured.size.y};
    return json;
  };
  return {{"max", sized(measured.max)},
          {"max_fine", sized(measured.max_fine)},
          {"sum", sized(measured.sum)}};
}

}  // namespace

void add_shells(const CompressedSet& built, const ProgressCallback& callback,
                Certifier& certifier) {
  ProgressMeter progress(callback, "certificate", built.shells.size());
  std::vector<Shell> part;
  std::size_t triangles = 0;
  for (std::size_t k = 0; k < built.shells.size(); ++k) {
    const CompressedShell& stored = built.shells[k];
    part.push_back(built.set.shells[k]);
    if (!stored.bytes.empty()) {
      part.back().surface = decode_draco(stored.bytes, {stored.triangles, stored.vertices});
    }
    triangles += stored.triangles;
    if (triangles >= kTrianglesAtOnce || k + 1 == built.shells.size()) {
      certifier.add(built.set, std::exchange(part, {}));
      triangles = 0;
    }
    progress.advance();
  }
}

std::string longest_certificate(const glm::ivec2& size) {
  // JSON's longest numbers of five digits: of emissions and decibels, and of any size.
  constexpr double kLong = -1.2345e-5;
  constexpr double kLongest = -1.2345e14;
  constexpr CertifiedError kMax{kLong, kLong, kLong, kLong, kLong, kLong};
  constexpr CertifiedError kSum{kLongest, kLongest, kLongest, kLongest, kLongest, kLongest};
  Certificate certificate;
  certificate.size = size;
  certificate.max = kMax;
  certificate.sum = kSum;
  certificate.max_fine = kMax;
  certificate.max_emission_error = kLong;
  certificate.rms_emission_error = kLong;
  certificate.emission_error_bound = kLong;
  for (const CertificateView& view : certificate_views()) {
    certificate.views.push_back({view, kMax, kSum, kMax});
  }
  return certificate_json(certificate).dump();
}

ordered_json certify_set(const VolumeFlags& flags, const glm::ivec2& size,
                         const CompressedSet& built, Reporter& reporter, BuildFigures& figures) {
  Stopwatch watch;
  const EmissionVolume input =
      read_emission_volume_again(flags, EmissionMap::piecewise_linear(built.set.emission));
  check_unchanged(flags, input.volume, built.set.volume);
  Certifier certifier(input.volume, input.emission,
                      {.size = size, .progress = reporter.progress()});
  add_shells(built, reporter.progress(), certifier);
  ordered_json json = certificate_json(certifier.result());
  if (built.coarse) figures.coarse_error = coarse_error(built, reporter.progress(), certifier);
  figures.certificate = watch.lap();
  return json;
}

}  // namespace nacre
