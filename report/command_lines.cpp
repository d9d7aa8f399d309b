#include "report/command_lines.h"

#include <fmt/core.h>

namespace nacre {
namespace {

std::string_view mode_name(PictureMode mode) {
  switch (mode) {
    case PictureMode::Max: return "max";
    case PictureMode::Sum: return "sum";
    case PictureMode::Count: return "count";
    case PictureMode::Iso: return "iso";
  }
  return "";
}

/// Flags of what is shown, which shells, samples and the exact walk share.
std::string subject_flags(const Subject& subject, const CommandTexts& texts) {
  std::string flags = fmt::format(" --mode {} {}", mode_name(subject.mode), texts.camera);
  if (subject.cued) {
    flags += fmt::format(" --cue {},{},{}", texts.cue.a, texts.cue.b, texts.cue.beta0);
  }
  if (subject.with_tool) flags += fmt::format(" {}", texts.tools);
  return flags;
}

std::string exact_line(const Subject& subject, const CommandTexts& texts) {
  std::string line =
      fmt::format("nacre reference {}{}", texts.volume, subject_flags(subject, texts));
  if (subject.mode == PictureMode::Count || subject.mode == PictureMode::Iso) {
    line += fmt::format(" --levels {}", text_of(subject.levels));
  }
  return line + " -o exact-%03d.tif";
}

std::string build_line(const ShellRecipe& recipe, const CommandTexts& texts) {
  std::string line =
      fmt::format("nacre build {} --levels {}", texts.volume, text_of(recipe.levels));
  if (recipe.levels.uniform > 0) line += " --placement uniform";
  if (recipe.tolerance > 0.0) line += fmt::format(" --tolerance {}", recipe.tolerance);
  if (recipe.quantization_bits > 0) {
    line += fmt::format(" --quantization {}", recipe.quantization_bits);
  }
  return line + " --certificate none -o shells.glb";
}

std::string render_line(const Method& method, const CommandTexts& texts) {
  std::string line = fmt::format("nacre render shells.glb --backend {}{}", method.backend,
                                 subject_flags(method.subject, texts));
  if (method.depth != DepthFormat::D32F) {
    line += fmt::format(" --depth-buffer {}", name(method.depth));
  }
  if (method.target != TargetFormat::F32) line += fmt::format(" --target {}", name(method.target));
  if (method.occlusion != Occlusion::Auto) {
    line += fmt::format(" --occlusion {}", name(method.occlusion));
  }
  return line + " -o shells-%03d.tif";
}

std::string peer_line(const PeerRecipe& peer, const CommandTexts& texts) {
  return fmt::format("nacre_vtk_peers {} {} --caster {} --step {} -o peer-%03d.tif", texts.volume,
                     texts.camera, peer.caster, peer.step);
}

std::string sampled_line(const Method& method, const CommandTexts& texts) {
  return fmt::format("nacre render {} --method sampled --samples {}{} -o sampled-%03d.tif",
                     texts.volume, *method.samples, subject_flags(method.subject, texts));
}

}  // namespace

std::vector<std::string> command_lines(const Method& method, const CommandTexts& texts) {
  if (method.peer) {
    return {peer_line(*method.peer, texts), exact_line(method.subject, texts),
            "nacre compare peer-%03d.tif exact-%03d.tif"};
  }
  if (method.samples) {
    return {sampled_line(method, texts), exact_line(method.subject, texts),
            "nacre compare sampled-%03d.tif exact-%03d.tif"};
  }
  if (!method.shells) return {exact_line(method.subject, texts)};
  return {build_line(*method.shells, texts), render_line(method, texts),
          exact_line(method.subject, texts), "nacre compare shells-%03d.tif exact-%03d.tif"};
}

}  // namespace nacre
