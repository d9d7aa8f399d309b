#include "app/turntable_output.h"

#include <algorithm>
#include <deque>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/command.h"
#include "io/apng_picture.h"
#include "io/atomic_file.h"
#include "io/picture_file.h"
#include "io/png_picture.h"

namespace nacre {
namespace {

constexpr int kTurnMs = 6000;
constexpr int kLeastMs = 20;   // browsers slow down what is faster
constexpr int kMostMs = 1000;  // of one view

/// Files written under temporary names, which all get their own at the end.
class PendingFiles {
 public:
  void open(const std::string& name) { files_.emplace_back(name); }
  void write_last(std::span<const std::byte> bytes) {
    files_.back().write(bytes);
    files_.back().close();
  }
  void commit() {
    for (AtomicFile& file : files_) file.commit();
  }

 private:
  std::deque<AtomicFile> files_;
};

/// Takes displayed views in order to numbered PNGs or an animated one.
class DisplayedViews {
 public:
  /// Opens the first file: a name that cannot be is found before the work.
  DisplayedViews(const PictureFlags& flags, int views) : flags_(flags) {
    if (picture_format(flags.output) == PictureFormat::Apng) {
      animation_.emplace(flags.output, static_cast<std::size_t>(views),
                         std::clamp(kTurnMs / views, kLeastMs, kMostMs), flags.bits);
    } else {
      files_.open(numbered_name(flags.output, 0));
    }
  }

  void add(const DisplayImage& view) {
    if (animation_) {
      animation_->add(view);
      return;
    }
    if (added_ > 0) files_.open(numbered_name(flags_.output, added_));
    const std::string png = encode_png(view, flags_.bits);
    files_.write_last(std::as_bytes(std::span(png)));
    ++added_;
  }

  void commit() {
    if (animation_) {
      animation_->commit();
    } else {
      files_.commit();
    }
  }

 private:
  const PictureFlags& flags_;
  PendingFiles files_;
  std::optional<ApngWriter> animation_;
  int added_ = 0;
};

std::size_t bytes_of(const Picture& picture) {
  std::size_t bytes = picture.volume.pixels.size() * sizeof(float);
  if (picture.tools) bytes += picture.tools->colors.size() * (sizeof(glm::vec3) + 1);
  return bytes;
}

float largest_pixel(const Picture& picture) {
  const auto& pixels = picture.volume.pixels;
  return pixels.empty() ? 0.0F : *std::max_element(pixels.begin(), pixels.end());
}

/// One run over all views.
class Turntable {
 public:
  Turntable(const PictureFlags& flags, const TurntableOptions& options,
            const std::function<Picture(int)>& draw)
      : flags_(flags), options_(options), draw_(draw) {}

  TurntableResult run() {
    if (flags_.output.empty()) {
      for_each_view([](const Picture&) {});
    } else if (picture_format(flags_.output) == PictureFormat::Tiff) {
      write_measured();
    } else {
      write_displayed();
    }
    return std::move(result_);
  }

 private:
  /// Draws each view and gives it away; the last one is kept for the caller.
  template <class Use>
  void for_each_view(Use use) {
    for (int view = 0; view < options_.views; ++view) {
      Picture picture = draw_(view);
      use(picture);
      if (view + 1 == options_.views) result_.last = std::move(picture);
    }
  }

  void write_measured() {
    PendingFiles files;
    files.open(numbered_name(flags_.output, 0));
    int view = 0;
    for_each_view([&](const Picture& picture) {
      Stopwatch watch;
      if (view > 0) files.open(numbered_name(flags_.output, view));
      files.write_last(encode_measured_picture(picture.volume, picture_mode(flags_)));
      ++view;
      result_.write_seconds += watch.lap();
    });
    files.commit();
  }

  void write_displayed() {
    DisplayedViews views(flags_, options_.views);
    result_.window = window_known_before(flags_);
    std::vector<Picture> kept;
    if (!result_.window) {
      kept = draw_all();
      result_.window = default_display_window(largest_, picture_mode(flags_));
    }
    if (kept.empty()) {
      for_each_view([&](const Picture& picture) { show(picture, views); });
    } else {
      for (const Picture& picture : kept) show(picture, views);
      result_.last = std::move(kept.back());
    }
    views.commit();
  }

  /// Draws all views for their largest pixel; gives them back if they could be kept.
  std::vector<Picture> draw_all() {
    std::vector<Picture> kept;
    std::size_t kept_bytes = 0;
    bool keep = true;
    largest_ = 0.0F;
    for (int view = 0; view < options_.views; ++view) {
      Picture picture = draw_(view);
      largest_ = std::max(largest_, largest_pixel(picture));
      kept_bytes += bytes_of(picture);
      keep = keep && kept_bytes <= options_.most_kept_bytes;
      if (keep) {
        kept.push_back(std::move(picture));
      } else {
        kept = {};
      }
    }
    return kept;
  }

  void show(const Picture& picture, DisplayedViews& views) {
    Stopwatch watch;
    DisplayOptions options = display_options(flags_, *result_.window);
    options.rgb = options_.tools && options_.views > 1;  // all views alike
    views.add(display_picture(picture, options));
    result_.write_seconds += watch.lap();
  }

  const PictureFlags& flags_;
  const TurntableOptions& options_;
  const std::function<Picture(int)>& draw_;
  TurntableResult result_;
  float largest_ = 0.0F;
};

}  // namespace

TurntableResult write_views(const PictureFlags& flags, const TurntableOptions& options,
                            const std::function<Picture(int view)>& draw) {
  if (options.views > 1) keep_freed_memory();
  return Turntable(flags, options, draw).run();
}

}  // namespace nacre
