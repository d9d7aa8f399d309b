#pragma once

#include <string>

#include "app/command.h"

namespace nacre {

/// Says what a tool mesh holds, and writes its figures: `nacre info tool.stl`.
void run_tool_info(const std::string& path, Reporter& reporter);

}  // namespace nacre
