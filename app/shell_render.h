#pragma once

#include <cstddef>
#include <string>

#include "app/exact_command.h"
#include "app/shell_building.h"
#include "render/plan.h"
#include "render/render_options.h"

namespace nacre {

/// How shells are drawn, as flags say it.
struct DrawFlags {
  std::string backend = "auto";
  std::string layers = "fine";
  std::string depth_buffer = "32f";
  std::string target = "32f";
  std::string occlusion = "auto";
  std::string hide;  ///< shells, counted from 1, outermost first
  std::string only;
  double detail_px = 0.0;
  bool explain = false;
  bool coarse = false;  ///< the coarse copies of the shells, where the file has them
};

/// Adds --backend, --layers, --depth-buffer, --target, --occlusion, --hide, --only, --detail and
/// --explain.
void add_draw_flags(CLI::App& verb, DrawFlags& flags);

/// @throws Error  BadArgument for what the flags cannot mean
RenderOptions render_options(const ExactFlags& flags, const DrawFlags& draw, std::size_t shells);

/// Says what is drawn and what is left out, and why: --explain.
void say_plan(const Plan& plan, Reporter& reporter);

/// Draws a shell set file: plans, decodes and uploads what the plan draws, renders.
void run_shell_file(const ExactFlags& flags, const DrawFlags& draw);

/// The same for a volume, whose shells are built in memory.
void run_shells_of_volume(const ExactFlags& flags, const DrawFlags& draw, const ShellFlags& shells);

/// Prints the contexts that open on this machine, and those that do not with the reason.
void say_backends();

}  // namespace nacre
