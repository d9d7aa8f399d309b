#pragma once

#include "core/camera.h"
#include "core/shell_set.h"

namespace nacre::testing {

/// The shell picture by brute force: the largest representative among the shells that the ray
/// meets, in double; 0 if it meets none.
///
/// @param from_eye  whether the ray starts at its origin (perspective) or is a whole line
/// @param hidden    index of a shell to leave out; -1 for none
double ray_maximum(const ShellSet& set, const Ray& ray, bool from_eye, int hidden = -1);

}  // namespace nacre::testing
