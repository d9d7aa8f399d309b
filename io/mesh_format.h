#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace nacre {

/// The mesh formats of tools.
enum class MeshFormat { Stl, Obj, Ply, Off };

/// By the name's ending, in any case: .stl (also .stla, .stlb), .obj, .ply, .off.
std::optional<MeshFormat> mesh_format(const std::filesystem::path& path);

/// What a file is that is no tool mesh of the format its name says, in words: "a NIfTI volume".
/// Empty if nothing speaks against it.
///
/// @param bytes  the beginning of the file, 400 bytes of it suffice
std::string_view known_as_something_else(std::string_view bytes, MeshFormat format);

/// What a name's ending says of files that are no tools: "a shell set" for .glb; else empty.
std::string_view kind_by_ending(const std::filesystem::path& path);

}  // namespace nacre
