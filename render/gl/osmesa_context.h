#pragma once

#include <memory>

#include "render/gl/gl_context.h"

namespace nacre {

/// A core context of OSMesa, Mesa's software renderer without any window system, from
/// libOSMesa.so.8 (or .so.6) loaded at run time. Recent Mesa releases no longer ship it.
///
/// @throws Error  Unsupported if there is no such library, or it refuses OpenGL 3.3 core
std::unique_ptr<GlContext> open_osmesa_context();

}  // namespace nacre
