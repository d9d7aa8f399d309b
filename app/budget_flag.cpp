#include "app/budget_flag.h"

#include <fmt/core.h>

#include <array>
#include <charconv>
#include <string_view>

#include "core/error.h"

namespace nacre {
namespace {

struct NamedUnit {
  std::string_view name;
  double size;
  Budget::Unit unit;
};

constexpr auto kBytes = Budget::Unit::Bytes;
constexpr auto kTriangles = Budget::Unit::Triangles;
constexpr std::array<NamedUnit, 12> kUnits{{{"", 1.0, kBytes},
                                            {"B", 1.0, kBytes},
                                            {"kB", 1e3, kBytes},
                                            {"KB", 1e3, kBytes},
                                            {"MB", 1e6, kBytes},
                                            {"GB", 1e9, kBytes},
                                            {"KiB", 1024.0, kBytes},
                                            {"MiB", 1048576.0, kBytes},
                                            {"GiB", 1073741824.0, kBytes},
                                            {"tri", 1.0, kTriangles},
                                            {"ktri", 1e3, kTriangles},
                                            {"Mtri", 1e6, kTriangles}}};
constexpr double kMost = 1e15;  // beyond any file, within whole doubles

}  // namespace

Budget parse_budget(const std::string& text) {
  double number = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data(), end, number);
  const std::string_view unit(stop, static_cast<std::size_t>(end - stop));
  for (const NamedUnit& known : kUnits) {
    const double size = number * known.size;
    if (failure == std::errc{} && unit == known.name && size >= 1.0 && size <= kMost) {
      return {known.unit, static_cast<std::size_t>(size)};
    }
  }
  throw Error(ErrorCode::BadArgument,
              fmt::format("--budget: found '{}', expected bytes or triangles, such as 2MB, 300kB "
                          "or 300ktri",
                          text));
}

std::string budget_words(const Budget& budget) {
  return fmt::format("{} {}", budget.most,
                     budget.unit == Budget::Unit::Bytes ? "bytes" : "triangles");
}

}  // namespace nacre
