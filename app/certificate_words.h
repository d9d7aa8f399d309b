#pragma once

#include <nlohmann/json.hpp>

#include "app/command.h"

namespace nacre {

/// Says what a set's certificate states, as far as it is one of `nacre build`'s: what other
/// writers may have put there is passed over.
void say_certificate(const nlohmann::ordered_json& certificate, Reporter& reporter);

}  // namespace nacre
