#include "app/served_pictures.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "app/shell_render.h"
#include "core/error.h"
#include "core/volume_geometry.h"
#include "io/shell_reader.h"
#include "render/cpu/cpu_renderer.h"
#include "render/plan.h"

namespace nacre {
namespace {

constexpr std::array<std::string_view, 15> kTaken{
    "azimuth", "cue",         "display", "distance", "elevation", "hide", "layers", "mode",
    "look-at", "perspective", "roll",    "size",     "slab",      "view", "zoom"};

struct Flags {
  ExactFlags exact;
  DrawFlags draw;
};

Flags parse(const PictureRequest& request) {
  Flags flags;
  CLI::App app;
  add_draw_flags(app, flags.draw);
  add_camera_flags(app, flags.exact.camera);
  add_picture_flags(app, flags.exact.picture);
  add_scene_flags(app, flags.exact.scene);
  std::vector<std::string> arguments;
  for (const auto& [name, value] : request) {
    if (std::find(kTaken.begin(), kTaken.end(), name) == kTaken.end()) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("{}: found a flag that pictures of a page do not have", name));
    }
    arguments.push_back(fmt::format("--{}={}", name, value));
  }
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorCode::BadArgument, error.what());
  }
  return flags;
}

void check_size(const glm::ivec2& size) {
  if (std::max(size.x, size.y) <= kMostServedSide) return;
  throw Error(ErrorCode::BadArgument, fmt::format("--size: found {}x{}, expected up to {} a side",
                                                  size.x, size.y, kMostServedSide));
}

/// The display window, if the flags name one.
std::optional<DisplayWindow> window_of(const PictureFlags& flags) {
  const std::optional<DisplayWindow> window = window_known_before(flags);
  if (window &&
      !(std::isfinite(window->lo) && std::isfinite(window->hi) && window->lo < window->hi)) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("--display: found {},{}, expected LO < HI", window->lo, window->hi));
  }
  return window;
}

/// To the nearest of 256 steps of the window.
std::vector<std::byte> in_bytes(const Image& image, const DisplayWindow& window) {
  const auto lo = static_cast<float>(window.lo);
  const auto steps = static_cast<float>(255.0 / (window.hi - window.lo));
  std::vector<std::byte> bytes(image.pixels.size());
  std::transform(image.pixels.begin(), image.pixels.end(), bytes.begin(), [&](float value) {
    return static_cast<std::byte>(std::clamp((value - lo) * steps, 0.0F, 255.0F) + 0.5F);
  });
  return bytes;
}

/// Zeros that are worth a run of their own.
constexpr std::ptrdiff_t kLeastZeros = 8;
constexpr std::ptrdiff_t kLongestRun = 65535;

/// Where the next run of zeros begins.
const std::byte* next_zeros(const std::byte* from, const std::byte* end) {
  while (from != end) {
    from = std::find(from, end, std::byte{0});
    const std::byte* const beyond =
        std::find_if(from, end, [](std::byte b) { return b != std::byte{0}; });
    if (beyond == end || beyond - from >= kLeastZeros) return from;
    from = beyond;
  }
  return end;
}

void put(std::vector<std::byte>& out, std::ptrdiff_t length) {
  out.push_back(static_cast<std::byte>(length & 0xFF));
  out.push_back(static_cast<std::byte>(length >> 8));
}

}  // namespace

std::vector<std::byte> pack_runs(std::span<const std::byte> bytes) {
  std::vector<std::byte> out;
  const std::byte* at = bytes.data();
  const std::byte* const end = at + bytes.size();
  while (at != end) {
    const std::byte* const others = std::find_if(at, at + std::min(end - at, kLongestRun),
                                                 [](std::byte b) { return b != std::byte{0}; });
    put(out, others - at);
    at = next_zeros(others, others + std::min(end - others, kLongestRun));
    put(out, at - others);
    out.insert(out.end(), others, at);
  }
  return out;
}

class ServedPictures::Drawing {
 public:
  explicit Drawing(std::span<const std::byte> file) : file_(file) {}

  std::vector<std::byte> draw(const PictureRequest& request) {
    const Flags flags = parse(request);
    const CameraOptions asked = camera_options(flags.exact.camera);
    check_size(asked.size);
    const std::optional<DisplayWindow> window = window_of(flags.exact.picture);
    const std::lock_guard lock(mutex_);
    if (!renderer_) open();
    const RenderOptions options = render_options(flags.exact, flags.draw, facts_.shells.size());
    const Camera camera = make_camera(asked, sphere_);
    const Plan plan = make_plan(facts_, camera, options, renderer_->capabilities());
    const Picture picture = renderer_->render(camera, plan);
    return pack_runs(in_bytes(
        picture.volume, window ? *window : default_display_window(picture.volume, options.mode)));
  }

 private:
  void open() {
    const ShellSet set = decode_shell_set(file_, "the set");
    facts_ = scene_facts(set);
    sphere_ = bounding_sphere(set.volume.dims, set.volume.world_from_voxel);
    CpuRenderer renderer;
    renderer.upload(set);
    renderer_.emplace(std::move(renderer));
  }

  std::span<const std::byte> file_;
  std::mutex mutex_;
  std::optional<CpuRenderer> renderer_;  // of all that follows, once there is one
  SceneFacts facts_;
  BoundingSphere sphere_;
};

ServedPictures::ServedPictures(std::span<const std::byte> set)
    : drawing_(std::make_unique<Drawing>(set)) {}
ServedPictures::~ServedPictures() = default;

std::vector<std::byte> ServedPictures::draw(const PictureRequest& request) {
  return drawing_->draw(request);
}

}  // namespace nacre
