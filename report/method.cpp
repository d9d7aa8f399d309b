#include "report/method.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "core/error.h"

namespace nacre {
namespace {

constexpr std::array<ReportPart, 9> kParts{{
    {"max", "Maximum projection",
     "Each pixel shows the brightest emission along its ray. More levels are closer to the "
     "volume, and larger; more samples are closer, and slower."},
    {"simplified", "Maximum projection of simplified shells",
     "Shells with fewer triangles: each surface may be off by a stated emission (the tolerance)."},
    {"quantised", "Maximum projection of coarsely stored shells",
     "Shells whose coordinates are stored with fewer bits: smaller files, rougher surfaces."},
    {"sum", "Emission integral",
     "Each pixel adds up the emission along its ray, in emission times millimetres."},
    {"iso", "Lit surface", "The surface at half the full emission, under a light at the eye."},
    {"count", "Crossing count",
     "Each crossing of a shell adds its brightness; compared with the exact crossings of the "
     "same levels."},
    {"occlusion", "Maximum projection with a tool in the volume",
     "A tool hides what is behind it. Two ways to draw that, which agree."},
    {"depth", "Depth buffers, under a depth cue",
     "The cued maximum is kept in the depth buffer: of 16, 24 or 32 bits."},
    {"target", "Colour targets",
     "Sums are added up, and lit surfaces drawn, in floats of 32 or 16 bits or in 8 bits."},
}};

constexpr std::array<const char*, 2> kOpenGl{"osmesa", "egl"};
constexpr std::array<const char*, 3> kAll{"cpu", "osmesa", "egl"};

/// Collects methods; a part's exact walks are put in when its first method of a subject comes.
class MethodList {
 public:
  explicit MethodList(std::span<const std::string> only) : only_(only) {}

  void add(Method method) {
    if (!only_.empty() && std::ranges::find(only_, method.part) == only_.end()) return;
    Method exact{.id = method.part + "-exact", .part = method.part, .subject = method.subject};
    const auto same = [&](const Method& other) {
      return other.part == method.part && other.backend == "exact" &&
             other.subject == method.subject;
    };
    if (std::ranges::none_of(methods_, same)) {
      if (method.subject.mode == PictureMode::Count) {
        exact.id = fmt::format("{}-{}", exact.id, text_of(method.subject.levels));
      } else if (method.part == "target") {
        exact.id += method.subject.mode == PictureMode::Sum ? "-sum" : "-iso";
      }
      methods_.push_back(exact);
    }
    methods_.push_back(std::move(method));
  }

  std::vector<Method> take() { return std::move(methods_); }

 private:
  std::span<const std::string> only_;
  std::vector<Method> methods_;
};

void add_max(MethodList& list, bool quick) {
  const std::vector<std::size_t> counts =
      quick ? std::vector<std::size_t>{12, 24} : std::vector<std::size_t>{6, 12, 24, 48};
  for (const char* backend : kAll) {
    for (const std::size_t count : counts) {
      list.add({.id = fmt::format("max-{}-{}", count, backend),
                .part = "max",
                .shells = ShellRecipe{{count}},
                .backend = backend});
    }
  }
}

/// Maximum projections by samples along rays, several numbers of them.
void add_sampled(MethodList& list, bool quick) {
  const std::vector<int> numbers = quick ? std::vector<int>{1, 2} : std::vector<int>{1, 2, 4};
  for (const int samples : numbers) {
    list.add({.id = fmt::format("max-sampled-{}", samples),
              .part = "max",
              .samples = samples,
              .backend = "sampled"});
  }
}

/// Maximum projections by VTK, at several distances between samples.
void add_peers(MethodList& list, bool quick) {
  const std::vector<double> steps =
      quick ? std::vector<double>{0.5, 1.0} : std::vector<double>{0.25, 0.5, 1.0, 2.0};
  for (const char* caster : {"fixed", "gpu"}) {
    for (const double step : steps) {
      list.add({.id = fmt::format("max-vtk-{}-{}", caster, step),
                .part = "max",
                .peer = PeerRecipe{caster, step},
                .backend = fmt::format("vtk-{}", caster)});
    }
  }
}

void add_simplified(MethodList& list, bool quick) {
  const std::vector<double> tolerances =
      quick ? std::vector<double>{0.0, 0.02} : std::vector<double>{0.0, 0.005, 0.01, 0.02, 0.05};
  for (const double tolerance : tolerances) {
    list.add({.id = fmt::format("simplified-{}-cpu", tolerance),
              .part = "simplified",
              .shells = ShellRecipe{{24}, tolerance},
              .backend = "cpu"});
  }
}

void add_quantised(MethodList& list, bool quick) {
  const std::vector<int> widths =
      quick ? std::vector<int>{0, 10} : std::vector<int>{0, 9, 10, 11, 12};
  for (const int bits : widths) {
    list.add(
        {.id = bits == 0 ? std::string("quantised-own-cpu") : fmt::format("quantised-{}-cpu", bits),
         .part = "quantised",
         .shells = ShellRecipe{{24}, 0.0, bits},
         .backend = "cpu"});
  }
}

void add_sum(MethodList& list, bool quick) {
  const std::vector<std::size_t> counts =
      quick ? std::vector<std::size_t>{12, 24} : std::vector<std::size_t>{6, 12, 24, 48};
  for (const char* backend : kAll) {
    for (const std::size_t count : counts) {
      list.add({.id = fmt::format("sum-{}-{}", count, backend),
                .part = "sum",
                .subject = {.mode = PictureMode::Sum},
                .shells = ShellRecipe{{count}},
                .backend = backend});
    }
  }
}

void add_iso(MethodList& list, bool quick) {
  const LevelChoice half{.uniform = 0, .single = 0.5};
  const std::vector<double> tolerances =
      quick ? std::vector<double>{0.0} : std::vector<double>{0.0, 0.01, 0.05};
  for (const char* backend : kAll) {
    for (const double tolerance : tolerances) {
      list.add({.id = tolerance > 0.0 ? fmt::format("iso-{}-{}", tolerance, backend)
                                      : fmt::format("iso-{}", backend),
                .part = "iso",
                .subject = {.mode = PictureMode::Iso, .levels = half},
                .shells = ShellRecipe{half, tolerance},
                .backend = backend});
    }
  }
}

void add_count(MethodList& list, bool quick) {
  const std::vector<std::size_t> counts =
      quick ? std::vector<std::size_t>{12} : std::vector<std::size_t>{6, 12};
  for (const char* backend : kAll) {
    for (const std::size_t count : counts) {
      list.add({.id = fmt::format("count-{}-{}", count, backend),
                .part = "count",
                .subject = {.mode = PictureMode::Count, .levels = {count}},
                .shells = ShellRecipe{{count}},
                .backend = backend});
    }
  }
}

void add_occlusion(MethodList& list) {
  for (const char* backend : kAll) {
    for (const Occlusion way : {Occlusion::Texture, Occlusion::Passes}) {
      list.add({.id = fmt::format("occlusion-{}-{}", name(way), backend),
                .part = "occlusion",
                .subject = {.with_tool = true},
                .shells = ShellRecipe{{24}},
                .backend = backend,
                .occlusion = way});
    }
  }
}

void add_depth(MethodList& list) {
  for (const char* backend : kAll) {
    for (const DepthFormat depth : {DepthFormat::D16, DepthFormat::D24, DepthFormat::D32F}) {
      if (std::string_view(backend) == "cpu" && depth != DepthFormat::D32F) continue;
      list.add({.id = fmt::format("depth-{}-{}", name(depth), backend),
                .part = "depth",
                .subject = {.cued = true},
                .shells = ShellRecipe{{24}},
                .backend = backend,
                .depth = depth});
    }
  }
}

void add_target(MethodList& list) {
  const LevelChoice half{.uniform = 0, .single = 0.5};
  const std::array<Subject, 2> subjects{Subject{.mode = PictureMode::Sum},
                                        Subject{.mode = PictureMode::Iso, .levels = half}};
  for (const Subject& subject : subjects) {
    const bool sum = subject.mode == PictureMode::Sum;
    for (const char* backend : kOpenGl) {
      for (const TargetFormat target : {TargetFormat::U8, TargetFormat::F16, TargetFormat::F32}) {
        list.add({.id = fmt::format("target-{}-{}-{}", sum ? "sum" : "iso", name(target), backend),
                  .part = "target",
                  .subject = subject,
                  .shells = ShellRecipe{sum ? LevelChoice{24} : half},
                  .backend = backend,
                  .target = target});
      }
    }
  }
}

void check_parts(std::span<const std::string> only) {
  for (const std::string& name : only) {
    if (std::ranges::find(kParts, name, &ReportPart::name) != kParts.end()) continue;
    std::string known;
    for (const ReportPart& part : kParts) {
      known += fmt::format("{}{}", known.empty() ? "" : ", ", part.name);
    }
    throw Error(ErrorCode::BadArgument,
                fmt::format("report: found the part '{}', expected some of {}", name, known));
  }
}

}  // namespace

std::vector<Level> levels_of(const LevelChoice& choice) {
  return choice.uniform > 0 ? uniform_levels(choice.uniform) : explicit_levels({&choice.single, 1});
}

std::string text_of(const LevelChoice& choice) {
  return choice.uniform > 0 ? fmt::format("{}", choice.uniform)
                            : fmt::format("{:#}", choice.single);
}

std::span<const ReportPart> report_parts() { return kParts; }

bool is_exact(const Method& method) { return !method.shells && !is_sampled(method); }

bool is_sampled(const Method& method) { return method.peer || method.samples; }

std::vector<Method> report_methods(const MethodChoice& choice) {
  check_parts(choice.only);
  MethodList list(choice.only);
  add_sampled(list, choice.quick);
  if (choice.with_peers) add_peers(list, choice.quick);
  add_max(list, choice.quick);
  add_simplified(list, choice.quick);
  add_quantised(list, choice.quick);
  add_sum(list, choice.quick);
  add_iso(list, choice.quick);
  add_count(list, choice.quick);
  add_occlusion(list);
  add_depth(list);
  add_target(list);
  return list.take();
}

}  // namespace nacre
