#pragma once

#include <string>

#include "report/command_lines.h"
#include "report/machine.h"

namespace nacre {

/// What a report says beside its figures.
struct ReportContext {
  std::string volume;      ///< its name
  std::string samples;     ///< "256 x 256 x 124 samples of i16, 0.7 x 0.7 x 1 mm"
  std::string window;      ///< "400 to 1400"
  std::string views;       ///< "6 views of 512 x 512 pixels"
  std::string version;     ///< of Nacre
  std::string repeats_it;  ///< the command that makes the report
  MachineFacts machine;
  CommandTexts commands;
};

}  // namespace nacre
