#include "render/render_options.h"

#include <array>

namespace nacre {
namespace {

struct NamedDepthFormat {
  DepthFormat format;
  std::string_view name;
};

constexpr std::array<NamedDepthFormat, 3> kDepthFormats{
    {{DepthFormat::D16, "16"}, {DepthFormat::D24, "24"}, {DepthFormat::D32F, "32f"}}};

}  // namespace

std::string_view name(DepthFormat format) noexcept {
  for (const NamedDepthFormat& entry : kDepthFormats) {
    if (entry.format == format) return entry.name;
  }
  return "";
}

std::optional<DepthFormat> depth_format(std::string_view name) noexcept {
  for (const NamedDepthFormat& entry : kDepthFormats) {
    if (entry.name == name) return entry.format;
  }
  return std::nullopt;
}

}  // namespace nacre
