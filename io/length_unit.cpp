#include "io/length_unit.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "io/bad_file.h"

namespace nacre {

double mm_per_unit(const char* name, VolumeReadReport& report) {
  using Unit = std::pair<std::string_view, double>;
  constexpr std::array<Unit, 16> units{{{"", 1.0},
                                        {"mm", 1.0},
                                        {"millimeter", 1.0},
                                        {"millimeters", 1.0},
                                        {"millimetre", 1.0},
                                        {"cm", 10.0},
                                        {"m", 1000.0},
                                        {"meter", 1000.0},
                                        {"meters", 1000.0},
                                        {"um", 1e-3},
                                        {"\u00b5m", 1e-3},
                                        {"\u03bcm", 1e-3},
                                        {"micron", 1e-3},
                                        {"microns", 1e-3},
                                        {"nm", 1e-6},
                                        {"???", 1.0}}};
  const std::string_view wanted = name == nullptr ? "" : name;
  const auto* found = std::find_if(units.begin(), units.end(),
                                   [&](const Unit& unit) { return unit.first == wanted; });
  if (found != units.end()) return found->second;
  const std::string warning = "unknown unit \"" + printable(wanted) + "\" taken as mm";
  if (std::find(report.warnings.begin(), report.warnings.end(), warning) == report.warnings.end()) {
    report.warnings.push_back(warning);
  }
  return 1.0;
}

}  // namespace nacre
