#include "reference/shell_picture.h"

#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <span>

#include "core/error.h"
#include "core/volume_border.h"
#include "core/volume_silhouette.h"
#include "reference/shell_pixels.h"
#include "reference/smooth_normals.h"
#include "reference/triangle_bins.h"

namespace nacre {
namespace {

constexpr int kBandRows = 8;
/// Pixels are worked on so many at a time: some 70 MB of rays.
constexpr std::int64_t kPixelsAtOnce = 1 << 19;

struct ShownShell {
  const TriangleMesh* surface = nullptr;
  double representative = 0.0;
  double step = 0.0;  ///< in sums, over the previous shown shell
};

std::vector<ShownShell> shown_shells(const ShellSet& set, std::span<const std::uint32_t> hidden) {
  for (const std::uint32_t k : hidden) {
    if (k < set.shells.size()) continue;
    throw Error(ErrorCode::BadArgument,
                fmt::format("hidden shells: found {}, expected 1 to {}", k + 1, set.shells.size()));
  }
  std::vector<ShownShell> shown;
  double previous = 0.0;
  for (std::uint32_t k = 0; k < set.shells.size(); ++k) {
    if (std::ranges::find(hidden, k) != hidden.end()) continue;
    const Shell& shell = set.shells[k];
    const double summed = sum_representative(shell);
    shown.push_back({&shell.surface, shell.representative, summed - previous});
    previous = summed;
  }
  return shown;
}

ShellBounds bounds_of(std::span<const ShownShell> shells, const glm::dvec3& center_mm) {
  std::vector<ShellBounds> each(shells.size());
  tbb::parallel_for(std::size_t{0}, shells.size(), [&](std::size_t i) {
    for (const glm::vec3& p : shells[i].surface->positions) {
      each[i].lo_mm = glm::min(each[i].lo_mm, glm::dvec3(p));
      each[i].hi_mm = glm::max(each[i].hi_mm, glm::dvec3(p));
    }
  });
  ShellBounds all;
  for (const ShellBounds& bounds : each) {
    all.lo_mm = glm::min(all.lo_mm, bounds.lo_mm + center_mm);
    all.hi_mm = glm::max(all.hi_mm, bounds.hi_mm + center_mm);
  }
  return all;
}

/// No crossing within the bounds has a larger cue (but for rounding).
double largest_beta(const Camera& camera, const DepthCue& cue, const ShellBounds& bounds) {
  double largest = 0.0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p((corner & 1U) != 0 ? bounds.hi_mm.x : bounds.lo_mm.x,
                       (corner & 2U) != 0 ? bounds.hi_mm.y : bounds.lo_mm.y,
                       (corner & 4U) != 0 ? bounds.hi_mm.z : bounds.lo_mm.z);
    largest = std::max(largest, beta(cue, depth_z(camera, p)));
  }
  return is_flat(cue) ? beta(cue, 0.0) : largest * (1.0 + 1e-12);
}

class ShellPainter {
 public:
  ShellPainter(const ShellSet& set, const Camera& camera, const ShellPictureOptions& options)
      : center_mm_(set.center_mm),
        camera_(camera),
        options_(options),
        shells_(shown_shells(set, options.hidden)),
        footprint_(camera) {
    cut_at_border(set);
    bounds_ = bounds_of(shells_, center_mm_);
    if (!(bounds_.lo_mm.x <= bounds_.hi_mm.x)) shells_.clear();
    if (options.mode != PictureMode::Iso && has_border(set.volume)) {
      columns_ = volume_silhouette(camera, set.volume.dims, set.volume.world_from_voxel);
    }
  }

  Picture paint(const ProgressCallback& progress) {
    Picture picture = make_picture(camera_, options_.tools);
    ShellPixels pixels(camera_, options_.cue, options_.slab, bounds_, options_.tools,
                       picture.tools ? &*picture.tools : nullptr);
    pixels_ = &pixels;
    const auto rows = static_cast<int>(std::max<std::int64_t>(1, kPixelsAtOnce / camera_.size.x));
    const int strips = (camera_.size.y + rows - 1) / rows;
    ProgressMeter meter(
        progress, "rays",
        std::max<std::size_t>(1, shells_.size() * static_cast<std::size_t>(strips)));
    for (int first = 0; first < camera_.size.y; first += rows) {
      paint_rows(first, std::min(first + rows, camera_.size.y), picture, meter);
    }
    drop_unseen_tools(picture);
    return picture;
  }

 private:
  void cut_at_border(const ShellSet& set) {
    within_.resize(shells_.size());
    tbb::parallel_for(std::size_t{0}, shells_.size(), [&](std::size_t i) {
      within_[i] = within_border(set, *shells_[i].surface);
      if (within_[i]) shells_[i].surface = &*within_[i];
    });
  }

  void paint_rows(int first, int end, Picture& picture, ProgressMeter& meter) {
    first_row_ = first;
    end_row_ = end;
    pixels_->begin(first, end);
    switch (options_.mode) {
      case PictureMode::Max: paint_max(meter); break;
      case PictureMode::Sum: paint_sum(meter); break;
      case PictureMode::Count: paint_count(meter); break;
      case PictureMode::Iso: paint_iso(meter); break;
    }
    for_each_pixel([&](int x, int y, const ShellPixel& pixel) {
      picture.volume.at(x, y) = static_cast<float>(pixel.value);
    });
  }

  void paint_max(ProgressMeter& meter) {
    const double largest = shells_.empty() ? 0.0 : largest_beta(camera_, options_.cue, bounds_);
    std::vector<ShownShell> brightest_first = shells_;
    std::ranges::stable_sort(brightest_first, std::greater{}, &ShownShell::representative);
    for (const ShownShell& shell : brightest_first) {
      const double r = shell.representative;
      for_each_crossing(
          *shell.surface,
          [&](const ShellPixel& pixel) {
            return r * largest > pixel.value || !std::isnan(pixel.counted_from_mm);
          },
          [&](ShellPixel& pixel, const TriangleCrossing& met, std::uint32_t) {
            if (pixel.shows(met.t_mm))
              pixel.value = std::max(pixel.value, r * pixel.beta(met.t_mm));
            if (met.t_mm > pixel.counted_from_mm) pixel.around += met.entering ? -1 : 1;
          });
      meter.advance();
    }
    add_ends();
  }

  /// Within n shells the ray shows r_n where it starts (or ends).
  void add_ends() {
    for_each_pixel([&](int, int, ShellPixel& pixel) {
      if (pixel.around <= 0 || pixel.is_empty()) return;
      const auto n = std::min(static_cast<std::size_t>(pixel.around), shells_.size());
      pixel.value =
          std::max(pixel.value, shells_[n - 1].representative * pixel.beta(pixel.counted_from_mm));
    });
  }

  /// Calls `function(x, y, pixel)` with all that a triangle came near.
  template <class Function>
  void for_each_pixel(Function&& function) {
    tbb::parallel_for(first_row_, end_row_, [&](int y) {
      for (int x = 0; x < camera_.size.x; ++x) {
        if (ShellPixel* pixel = pixels_->find(x, y)) function(x, y, *pixel);
      }
    });
  }

  void paint_sum(ProgressMeter& meter) {
    for (const ShownShell& shell : shells_) {
      const double step = shell.step;
      for_each_crossing(
          *shell.surface, [](const ShellPixel&) { return true; },
          [&](ShellPixel& pixel, const TriangleCrossing& met, std::uint32_t) {
            const double t =
                std::clamp(met.t_mm, pixel.interval.t_begin_mm, pixel.interval.t_end_mm);
            pixel.value += (met.entering ? -step : step) * pixel.beta_integral(t);
          });
      meter.advance();
    }
  }

  void paint_count(ProgressMeter& meter) {
    for (const ShownShell& shell : shells_) {
      const double r = shell.representative;
      for_each_crossing(
          *shell.surface, [](const ShellPixel&) { return true; },
          [&](ShellPixel& pixel, const TriangleCrossing& met, std::uint32_t) {
            if (pixel.shows(met.t_mm)) pixel.value += r;
          });
      meter.advance();
    }
  }

  void paint_iso(ProgressMeter& meter) {
    find_normals();
    for (std::size_t k = 0; k < shells_.size(); ++k) {
      const TriangleMesh& surface = *shells_[k].surface;
      for_each_crossing(
          surface, [](const ShellPixel&) { return true; },
          [&](ShellPixel& pixel, const TriangleCrossing& met, std::uint32_t triangle) {
            if (!pixel.shows(met.t_mm)) return;
            // Later ones at the same t do not replace it: the outermost shell stays.
            pixel.interval.t_end_mm = std::nextafter(met.t_mm, -INFINITY);
            const glm::uvec3& t = surface.triangles[triangle];
            const glm::dvec3 normal = met.weights.x * normals_[k][t.x] +
                                      met.weights.y * normals_[k][t.y] +
                                      met.weights.z * normals_[k][t.z];
            const double length = glm::length(normal);
            const double cosine = length > 0.0 ? -glm::dot(normal, pixel.direction) / length : 0.0;
            pixel.value = headlight(cosine) * pixel.beta(met.t_mm);
          });
      meter.advance();
    }
  }

  void find_normals() {
    if (!normals_.empty()) return;
    normals_.resize(shells_.size());
    tbb::parallel_for(std::size_t{0}, shells_.size(),
                      [&](std::size_t k) { normals_[k] = smooth_normals(*shells_[k].surface); });
  }

  /// Calls `meet(pixel, crossing, triangle)` with every crossing of the rays of pixels that are
  /// wanted: for each pixel in the mesh's order, by one thread at a time.
  template <class Wants, class Meet>
  void for_each_crossing(const TriangleMesh& mesh, Wants&& wants, Meet&& meet) {
    const TriangleBins bins(mesh, center_mm_, footprint_, {first_row_, end_row_, kBandRows});
    tbb::parallel_for(
        tbb::blocked_range<int>(0, bins.band_count(), 1),
        [&](const tbb::blocked_range<int>& bands) {
          for (int band = bands.begin(); band != bands.end(); ++band) {
            for (std::size_t i = 0; i < bins.part_count(); ++i) {
              for (const BinnedTriangle& binned : bins.part(band, i)) {
                meet_pixels(mesh, binned, wants, meet);
              }
            }
          }
        },
        tbb::simple_partitioner());
  }

  /// Rays that miss the volume's box meet nothing.
  PixelSpan columns_at(int y) const {
    if (columns_.empty()) return {0, camera_.size.x};
    return columns_[static_cast<std::size_t>(y)];
  }

  template <class Wants, class Meet>
  void meet_pixels(const TriangleMesh& mesh, const BinnedTriangle& binned, Wants&& wants,
                   Meet&& meet) {
    const glm::uvec3& t = mesh.triangles[binned.triangle];
    const glm::dvec3 a = center_mm_ + glm::dvec3(mesh.positions[t.x]);
    const glm::dvec3 b = center_mm_ + glm::dvec3(mesh.positions[t.y]);
    const glm::dvec3 c = center_mm_ + glm::dvec3(mesh.positions[t.z]);
    for (int y = binned.pixels.first.y; y <= binned.pixels.last.y; ++y) {
      const PixelSpan columns = columns_at(y);
      for (int x = std::max(binned.pixels.first.x, columns.first);
           x <= std::min(binned.pixels.last.x, columns.end - 1); ++x) {
        ShellPixel& pixel = pixels_->at(x, y);
        if (pixel.is_empty() || !wants(pixel)) continue;
        const auto met = crossing(pixel.along(a), pixel.along(b), pixel.along(c));
        if (met) meet(pixel, *met, binned.triangle);
      }
    }
  }

  glm::dvec3 center_mm_;
  const Camera& camera_;
  const ShellPictureOptions& options_;
  std::vector<ShownShell> shells_;                   ///< outermost first
  std::vector<std::optional<TriangleMesh>> within_;  ///< of those, where they differ
  ShellBounds bounds_;
  PixelFootprint footprint_;
  std::vector<std::vector<glm::dvec3>> normals_;  ///< of each shell; for iso
  std::vector<PixelSpan> columns_;                ///< that meet the volume's box; empty: all
  int first_row_ = 0;                             ///< of the pixels at hand
  int end_row_ = 0;
  ShellPixels* pixels_ = nullptr;
};

}  // namespace

Picture shell_picture(const ShellSet& set, const Camera& camera, const ShellPictureOptions& options,
                      const ProgressCallback& progress) {
  check_cue(options.cue);
  check_slab(options.slab);
  return ShellPainter(set, camera, options).paint(progress);
}

}  // namespace nacre
