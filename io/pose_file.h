#pragma once

#include <filesystem>
#include <glm/mat4x4.hpp>

namespace nacre {

/// Reads the pose of a tool: 16 numbers, the rows of the 4x4 matrix that takes tool coordinates
/// (already in mm) to LPS millimetres, separated by blanks, line ends or commas; from '#' on, the
/// rest of a line is a comment.
///
/// The matrix is a rigid motion: its rotation orthonormal to 1e-4 with determinant +1, its last row
/// 0 0 0 1. The rotation is taken as it stands.
///
/// @throws Error  BadFile for anything else
glm::dmat4 read_pose(const std::filesystem::path& path);

}  // namespace nacre
