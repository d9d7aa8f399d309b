#pragma once

#include <cstddef>
#include <cstdint>

/// The constants of the shell file, `docs/shell_file.md`, that writer and reader share.
namespace nacre::shell_file {

inline constexpr int kFormatVersion = 1;

// The binary glTF container (glTF 2.0, section 4.4).
inline constexpr std::uint32_t kGlbMagic = 0x46546C67;  // "glTF"
inline constexpr std::uint32_t kGlbVersion = 2;
inline constexpr std::uint32_t kJsonChunk = 0x4E4F534A;    // "JSON"
inline constexpr std::uint32_t kBinaryChunk = 0x004E4942;  // "BIN\0"
inline constexpr std::size_t kGlbHeaderSize = 12;
inline constexpr std::size_t kChunkHeaderSize = 8;

// glTF's names for types.
inline constexpr int kComponentUint32 = 5125;
inline constexpr int kComponentFloat = 5126;
inline constexpr int kModeTriangles = 4;

inline constexpr const char* kDracoExtension = "KHR_draco_mesh_compression";
inline constexpr const char* kUnlitExtension = "KHR_materials_unlit";

// Limits that a reader holds a file to before it allocates anything.
inline constexpr std::size_t kMaxJsonSize = std::size_t{16} << 20;
inline constexpr int kMaxJsonDepth = 64;

}  // namespace nacre::shell_file
