#include "render/render_options.h"

#include <array>
#include <cstddef>

namespace nacre {
namespace {

template <class Value>
struct Named {
  Value value;
  std::string_view name;
};

constexpr std::array<Named<DepthFormat>, 3> kDepthFormats{
    {{DepthFormat::D16, "16"}, {DepthFormat::D24, "24"}, {DepthFormat::D32F, "32f"}}};
constexpr std::array<Named<TargetFormat>, 3> kTargetFormats{
    {{TargetFormat::U8, "8"}, {TargetFormat::F16, "16f"}, {TargetFormat::F32, "32f"}}};
constexpr std::array<Named<Occlusion>, 3> kOcclusions{
    {{Occlusion::Auto, "auto"}, {Occlusion::Passes, "passes"}, {Occlusion::Texture, "texture"}}};
constexpr std::array<Named<Layers>, 3> kLayers{
    {{Layers::Flat, "flat"}, {Layers::Smooth, "smooth"}, {Layers::Fine, "fine"}}};

template <class Value, std::size_t Size>
std::string_view name_in(const std::array<Named<Value>, Size>& names, Value value) noexcept {
  for (const Named<Value>& entry : names) {
    if (entry.value == value) return entry.name;
  }
  return "";
}

template <class Value, std::size_t Size>
std::optional<Value> value_in(const std::array<Named<Value>, Size>& names,
                              std::string_view name) noexcept {
  for (const Named<Value>& entry : names) {
    if (entry.name == name) return entry.value;
  }
  return std::nullopt;
}

}  // namespace

std::string_view name(DepthFormat format) noexcept { return name_in(kDepthFormats, format); }
std::string_view name(TargetFormat format) noexcept { return name_in(kTargetFormats, format); }
std::string_view name(Occlusion occlusion) noexcept { return name_in(kOcclusions, occlusion); }
std::string_view name(Layers layers) noexcept { return name_in(kLayers, layers); }

std::optional<DepthFormat> depth_format(std::string_view name) noexcept {
  return value_in(kDepthFormats, name);
}
std::optional<TargetFormat> target_format(std::string_view name) noexcept {
  return value_in(kTargetFormats, name);
}
std::optional<Occlusion> occlusion(std::string_view name) noexcept {
  return value_in(kOcclusions, name);
}
std::optional<Layers> layers(std::string_view name) noexcept { return value_in(kLayers, name); }

}  // namespace nacre
