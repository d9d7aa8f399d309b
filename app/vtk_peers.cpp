// `nacre_vtk_peers`: VTK's maximum projections of a volume, by the flags of `nacre reference`, for
// `nacre report` to compare with. A program of its own: nacre would wait for VTK's libraries at
// every start.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "app/camera_flags.h"
#include "app/command.h"
#include "app/failures.h"
#include "app/picture_output.h"
#include "app/thread_limit.h"
#include "app/turntable_output.h"
#include "app/volume_flags.h"
#include "core/error.h"
#include "peers/vtk_maximum.h"

namespace nacre {
namespace {

constexpr const char* kProgram = "nacre_vtk_peers";

struct PeerFlags {
  CommonFlags common;
  VolumeFlags volume;
  CameraFlags camera;
  PictureFlags picture;
  std::string caster = "fixed";
  double step = 0.5;
  bool serve = false;
};

VtkSampling sampling_of(const std::string& caster, double step) {
  const std::optional<VtkCaster> known = vtk_caster(caster);
  if (!known) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("--caster: found '{}', expected fixed or gpu", caster));
  }
  return {*known, step};
}

/// The volume in VTK's hands, from the flags' camera.
class VtkViews {
 public:
  VtkViews(const PeerFlags& flags, Reporter& reporter)
      : flags_(flags),
        camera_(camera_options(flags.camera)),
        input_(read_emission_volume(flags.volume, reporter)) {}

  int count() const { return std::max(flags_.camera.turntable, 1); }

  Image draw(const VtkSampling& sampling, int view) {
    if (!flags_.camera.slab.empty()) {
      throw Error(ErrorCode::Unsupported, "VTK's ray casters draw whole volumes here, no slabs");
    }
    if (!vtk_) vtk_.emplace(input_.volume, input_.emission, camera_.size);
    CameraOptions camera = camera_;
    camera.azimuth_rad += 2.0 * std::numbers::pi * view / count();
    const BoundingSphere sphere =
        bounding_sphere(input_.volume.dims, input_.volume.world_from_voxel);
    return vtk_->draw(make_camera(camera, sphere), sampling);
  }

  std::string device_name(VtkCaster caster) const { return vtk_->device_name(caster); }

 private:
  const PeerFlags& flags_;
  const CameraOptions camera_;
  const EmissionVolume input_;
  std::optional<VtkMaximum> vtk_;
};

/// Answers one line of `PeerProcess`.
void answer(const std::string& order, VtkViews& views) {
  std::istringstream words(order);
  std::string caster;
  double step = 0.0;
  int view = 0;
  words >> caster >> step >> view;
  try {
    const VtkSampling sampling = sampling_of(caster, step);
    Stopwatch watch;
    const Image picture = views.draw(sampling, view);
    fmt::print("picture {} {} {} {}\n", watch.lap(), picture.width, picture.height,
               views.device_name(sampling.caster));
    std::fwrite(picture.pixels.data(), sizeof(float), picture.pixels.size(), stdout);
  } catch (const Error& error) {
    fmt::print("refused {}\n", error.what());
  }
  std::fflush(stdout);
}

int serve(const PeerFlags& flags, Reporter& reporter) {
  VtkViews views(flags, reporter);
  fmt::print("ready\n");
  std::fflush(stdout);
  for (std::string order; std::getline(std::cin, order);) answer(order, views);
  return 0;
}

int draw(const PeerFlags& flags, Reporter& reporter) {
  const VtkSampling sampling = sampling_of(flags.caster, flags.step);
  check_output(flags.picture, flags.camera);
  VtkViews views(flags, reporter);
  Stopwatch watch;
  double seconds = 0.0;
  const auto one = [&](int view) {
    watch.lap();
    Picture picture{views.draw(sampling, view), std::nullopt};
    seconds += watch.lap();
    return picture;
  };
  write_views(flags.picture, {.views = views.count()}, one);
  reporter.say(fmt::format("{} pictures by {}, {:.1f} ms each -> {}", views.count(),
                           views.device_name(sampling.caster), 1e3 * seconds / views.count(),
                           flags.picture.output));
  reporter.finish({{"renderer", views.device_name(sampling.caster)}});
  return 0;
}

int run(const PeerFlags& flags) {
  Reporter reporter(flags.common);
  const ThreadLimit limit(flags.common);
  VtkMaximum::set_threads(flags.common.threads);
  return flags.serve ? serve(flags, reporter) : draw(flags, reporter);
}

int run_peers(int argc, char** argv) {
  CLI::App app{"Maximum projections of a volume by VTK's ray casters, to compare Nacre's with",
               kProgram};
  PeerFlags flags;
  app.add_option("VOLUME", flags.volume.path, "Volume file, or folder of a DICOM series")
      ->required();
  app.add_option("-o,--output", flags.picture.output, "Picture: .png or .tif");
  app.add_option("--caster", flags.caster, "fixed (on the processor) or gpu (OpenGL)")
      ->capture_default_str();
  app.add_option("--step", flags.step, "Between samples, in mean spacings of the volume")
      ->capture_default_str();
  app.add_flag("--serve", flags.serve, "Draw what standard input asks for: for nacre report")
      ->group("");
  add_camera_flags(app, flags.camera);
  add_volume_reading_flags(app, flags.volume);
  add_emission_flags(app, flags.volume);
  add_common_flags(app, flags.common);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wish) {
    return app.exit(wish);
  } catch (const CLI::ParseError& error) {
    return complain(kProgram, error.what(), kWrongUse);
  }
  return run(flags);
}

}  // namespace
}  // namespace nacre

int main(int argc, char** argv) {
  return nacre::guarded(nacre::kProgram, [&] { return nacre::run_peers(argc, argv); });
}
