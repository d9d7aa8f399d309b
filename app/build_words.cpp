// What `nacre build` says of its shells.
#include "app/build_words.h"

#include <fmt/core.h>

namespace nacre {
namespace {

using nlohmann::ordered_json;

ordered_json left_out_item(const ComponentCount& count, const std::string& what,
                           const std::string& why) {
  return {{"what", fmt::format("{} {}", count.components, what)},
          {"why", why},
          {"components", count.components},
          {"triangles", count.triangles},
          {"volume_mm3", count.volume_mm3}};
}

}  // namespace

ordered_json tell_pruning(const Pruning& pruned, Reporter& reporter) {
  ordered_json left_out = ordered_json::array();
  if (pruned.specks.components > 0) {
    ordered_json specks =
        left_out_item(pruned.specks, "specks",
                      fmt::format("components of less than {:.4g} mm3 (--keep-specks keeps them)",
                                  pruned.min_component_mm3));
    specks["largest_emission"] = pruned.largest_emission;
    left_out.push_back(std::move(specks));
    reporter.say(fmt::format(
        "left out {} specks of less than {:.4g} mm3: {} triangles, {:.4g} mm3, at most {:.3f} of "
        "emission in a pixel (--keep-specks keeps them)",
        pruned.specks.components, pruned.min_component_mm3, pruned.specks.triangles,
        pruned.specks.volume_mm3, pruned.largest_emission));
  }
  if (pruned.inner.components > 0) {
    left_out.push_back(left_out_item(
        pruned.inner, "inner components",
        "inside their own shell's surface, where no maximum projection without a slab "
        "shows them (--purpose all keeps them)"));
    reporter.say(fmt::format(
        "left out {} components inside their own shell: {} triangles, {:.4g} mm3 (no maximum "
        "projection shows them; --purpose all keeps them, for sums and slabs)",
        pruned.inner.components, pruned.inner.triangles, pruned.inner.volume_mm3));
  }
  return left_out;
}

ordered_json tell_nesting(const std::vector<NeighbourCrossings>& crossings, Reporter& reporter) {
  std::size_t pairs = 0;
  std::size_t crossing = 0;
  ordered_json list = ordered_json::array();
  for (const NeighbourCrossings& neighbours : crossings) {
    pairs += neighbours.pairs;
    crossing += neighbours.pairs > 0 ? 1 : 0;
    list.push_back({{"outer", neighbours.outer + 1},
                    {"inner", neighbours.inner + 1},
                    {"crossing_pairs", neighbours.pairs}});
  }
  if (!crossings.empty()) {
    reporter.say(
        fmt::format("nesting: {} pairs of triangles cross, in {} of {} pairs of neighbours", pairs,
                    crossing, crossings.size()));
  }
  return {{"crossing_pairs", pairs}, {"neighbours", list}};
}

}  // namespace nacre
