#include "io/dicom_series.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <system_error>
#include <vector>

#include "core/error.h"
#include "io/bad_file.h"
#include "io/dicom_slice.h"
#include "io/slice_stack.h"
#include "io/stored_samples.h"
#include "io/stretch.h"
#include "io/volume_checks.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

/// The slices of a series, and the file of each.
struct Slices {
  std::vector<fs::path> files;
  std::vector<DicomSlice> headers;
};

/// The images of a folder by series, in the order of their file names.
std::map<std::string, Slices> find_series(const fs::path& folder, VolumeReadReport& report) {
  std::vector<fs::path> files;
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure)) {
    if (entry.is_regular_file(failure)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::map<std::string, Slices> series;
  std::size_t others = 0;
  const std::vector<std::optional<DicomSlice>> found = read_dicom_slices(files);
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!found[i]) {
      ++others;
      continue;
    }
    Slices& slices = series[std::string(found[i]->series_uid())];
    slices.files.push_back(files[i]);
    slices.headers.push_back(*found[i]);
  }
  if (others > 0) {
    report.warnings.push_back(fmt::format("{} files without a DICOM image passed over", others));
  }
  return series;
}

/// "UID (19 slices of 256 x 256)", one after the other.
std::string list_of(const std::map<std::string, Slices>& series) {
  std::string list;
  for (const auto& [uid, slices] : series) {
    list += fmt::format("{}{} ({} slices of {} x {})", list.empty() ? "" : ", ", printable(uid),
                        slices.files.size(), slices.headers.front().columns,
                        slices.headers.front().rows);
  }
  return list;
}

Slices choose_series(const fs::path& folder, std::map<std::string, Slices> series,
                     const std::string& uid) {
  if (series.empty()) throw_bad_file(folder, "a folder without DICOM images", "a DICOM series");
  if (uid.empty() && series.size() == 1) return std::move(series.begin()->second);
  const auto chosen = series.find(uid);
  if (!uid.empty() && chosen != series.end()) return std::move(chosen->second);
  const std::string found = fmt::format("{} series: {}", series.size(), list_of(series));
  throw Error(ErrorCode::BadArgument,
              fmt::format("{}: found {}, expected --series with the UID of one of them",
                          folder.string(), found));
}

/// What GDCM could decode but this reader would misread.
void check_kind(const fs::path& path, const DicomSlice& slice) {
  if (slice.frames != 1) {
    throw_bad_file(path, "a multi-frame (enhanced) image", "one slice a file");
  }
  if (slice.samples_per_pixel != 1 || !slice.photometric().starts_with("MONOCHROME")) {
    throw_bad_file(path, fmt::format("colour samples ({})", printable(slice.photometric())),
                   "MONOCHROME1 or MONOCHROME2");
  }
  const bool whole_bytes =
      slice.bits_allocated == 8 || slice.bits_allocated == 16 || slice.bits_allocated == 32;
  if (!whole_bytes || slice.bits_stored < 1 || slice.bits_stored > slice.bits_allocated ||
      slice.high_bit != slice.bits_stored - 1) {
    throw_bad_file(path,
                   fmt::format("samples of {} bits, {} stored up to bit {}", slice.bits_allocated,
                               slice.bits_stored, slice.high_bit),
                   "8, 16 or 32 bits, stored from bit 0 on");
  }
  if (!slice.has_position) {
    throw_bad_file(path, "no position, orientation or pixel spacing",
                   "ImagePositionPatient, ImageOrientationPatient and PixelSpacing");
  }
  // Nothing that GDCM decodes packs an image tighter than this; a damaged size does.
  constexpr std::uint64_t max_growth = 16384;
  const std::int64_t size = slice.columns * slice.rows * slice.bits_allocated / 8;
  if (size < 1 || static_cast<std::uint64_t>(size) / max_growth > file_size_of(path)) {
    throw_bad_file(path, fmt::format("{} x {} samples", slice.columns, slice.rows),
                   "as many as the file can hold");
  }
  if (!holds_samples(path, slice.extent, static_cast<std::uint64_t>(size))) {
    throw_bad_file(
        path, "samples that the file's end cuts off",
        fmt::format("{} x {} samples of {} bits", slice.columns, slice.rows, slice.bits_allocated));
  }
}

void check_alike(const fs::path& folder, const Slices& slices) {
  const DicomSlice& first = slices.headers.front();
  for (std::size_t i = 0; i < slices.files.size(); ++i) {
    const DicomSlice& slice = slices.headers[i];
    check_kind(slices.files[i], slice);
    if (slice.columns != first.columns || slice.rows != first.rows) {
      throw_bad_file(folder,
                     fmt::format("slices of {} x {} and of {} x {} samples", first.columns,
                                 first.rows, slice.columns, slice.rows),
                     "slices of one size");
    }
    if (slice.bits_allocated != first.bits_allocated || slice.is_signed != first.is_signed) {
      throw_bad_file(folder, "slices of more than one type of samples", "the same in all");
    }
  }
}

SliceStack stack(const fs::path& folder, const Slices& slices, VolumeReadReport& report) {
  std::vector<SliceFrame> frames;
  for (const DicomSlice& slice : slices.headers) {
    frames.push_back({slice.position, slice.x_direction, slice.y_direction, slice.spacing_mm,
                      slice.thickness_mm});
  }
  SliceStack stack = stack_slices(folder, frames, report);
  check_geometry(folder, stack.world_from_voxel, report);
  return stack;
}

void warn_of_kind(const DicomSlice& slice, VolumeReadReport& report) {
  if (slice.photometric() == "MONOCHROME1") {
    report.warnings.emplace_back("MONOCHROME1: the lowest values are meant to be shown brightest");
  }
  if (slice.has_lookup_table) {
    report.warnings.emplace_back("a modality look-up table is not applied: values as stored");
  }
}

/// Reads the slices into their places.
Volume read_slices(const Slices& slices, const std::vector<std::size_t>& order, ScalarType type) {
  DicomSlice common = slices.headers.front();
  for (const DicomSlice& slice : slices.headers) {
    common.bits_stored = std::max(common.bits_stored, slice.bits_stored);
  }
  Volume volume =
      make_volume({common.columns, common.rows, static_cast<std::int64_t>(order.size())}, type);
  std::vector<fs::path> files;
  files.reserve(order.size());
  for (const std::size_t i : order) files.push_back(slices.files[i]);
  read_dicom_samples(files, common, {volume.samples.data(), volume.samples.size()});
  return volume;
}

/// The values of slices that scale differently, as f32.
Volume rescaled(const Volume& stored, const Slices& slices, const std::vector<std::size_t>& order) {
  Volume values = make_volume(stored.dims, ScalarType::F32);
  const std::span<float> to = samples_as<float>(values);
  const std::size_t slice_size = to.size() / order.size();
  visit_samples(stored, [&](auto from) {
    for (std::size_t i = 0; i < to.size(); ++i) {
      const DicomSlice& slice = slices.headers[order[i / slice_size]];
      to[i] = static_cast<float>(slice.slope * static_cast<double>(from[i]) + slice.intercept);
    }
  });
  return values;
}

}  // namespace

Volume read_dicom_series(const fs::path& folder, const std::string& series_uid,
                         VolumeReadReport& report) {
  report.format = "DICOM series";
  const Slices slices = choose_series(folder, find_series(folder, report), series_uid);
  check_alike(folder, slices);
  const DicomSlice& first = slices.headers.front();
  warn_of_kind(first, report);
  const SliceStack grid = stack(folder, slices, report);

  const auto type = static_cast<ScalarType>(
      integer_type(static_cast<std::size_t>(first.bits_allocated / 8), first.is_signed));
  Volume volume = read_slices(slices, grid.order, type);
  const bool one_scale =
      std::all_of(slices.headers.begin(), slices.headers.end(), [&](const DicomSlice& slice) {
        return slice.slope == first.slope && slice.intercept == first.intercept;
      });
  if (one_scale) {
    set_scaling(folder, first.slope, first.intercept, volume);
  } else {
    report.warnings.emplace_back("slices scale differently: values stored as f32");
    volume = rescaled(volume, slices, grid.order);
  }
  volume.world_from_voxel = grid.world_from_voxel;
  return volume;
}

}  // namespace nacre
