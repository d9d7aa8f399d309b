#include "app/certificate_words.h"

#include <fmt/core.h>

#include <optional>
#include <string>

namespace nacre {
namespace {

using nlohmann::ordered_json;

/// A member of a value that may be no object.
ordered_json member(const ordered_json& json, const char* key) {
  return json.is_object() && json.contains(key) ? json[key] : ordered_json();
}

/// No PSNR: there is no error.
std::string decibels(const ordered_json& psnr) {
  return psnr.is_number() ? fmt::format("{:.2f} dB", psnr.get<double>()) : "exact";
}

std::optional<double> number(const ordered_json& json, const char* key) {
  const ordered_json value = member(json, key);
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

void say_error(const char* what, const ordered_json& error, const std::string& views,
               Reporter& reporter) {
  const auto words = error_words(error);
  if (words) reporter.say(fmt::format("{} {}{}", what, *words, views));
}

}  // namespace

std::optional<std::string> error_words(const ordered_json& error) {
  const auto rmse = number(error, "rmse");
  const auto largest = number(error, "max_error");
  if (!rmse || !largest) return std::nullopt;
  return fmt::format("{}, {} over lit pixels, RMSE {:.4g}, largest error {:.4g}",
                     decibels(member(error, "psnr_db")), decibels(member(error, "psnr_lit_db")),
                     *rmse, *largest);
}

void say_copies_error(const ordered_json& coarse, Reporter& reporter) {
  say_error("copies       max, fine layers:", member(coarse, "max_fine"), "", reporter);
  say_error("copies       max:", member(coarse, "max"), "", reporter);
  say_error("copies       sum:", member(coarse, "sum"), "", reporter);
}

void say_certificate(const ordered_json& certificate, Reporter& reporter) {
  const ordered_json size = member(certificate, "size");
  const ordered_json views = member(certificate, "views");
  std::string over;
  if (views.is_array() && size.is_array() && size.size() == 2 && size[0].is_number_integer() &&
      size[1].is_number_integer()) {
    over = fmt::format(" ({} views of {} x {})", views.size(), size[0].get<long long>(),
                       size[1].get<long long>());
  }
  say_error("certified    max, fine layers:", member(certificate, "max_fine"), over, reporter);
  say_error("certified    max:", member(certificate, "max"), over, reporter);
  say_error("certified    sum:", member(certificate, "sum"), "", reporter);
  const ordered_json surfaces = member(certificate, "surfaces");
  const auto rms = number(surfaces, "rms_error");
  const auto largest = number(surfaces, "max_error");
  if (!rms || !largest) return;
  reporter.say(fmt::format("certified    surfaces: emission RMS {:.4g} off, {:.4g} at most", *rms,
                           *largest));
}

}  // namespace nacre
