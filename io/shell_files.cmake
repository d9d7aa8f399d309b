# nacre::io_shell_reader, nacre::io_shell_writer: shell sets as .glb (docs/shell_file.md).
find_package(draco REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(TBB REQUIRED)

nacre_library(io_shell_reader
  SOURCES draco_decode.cpp draco_guard.cpp glb_container.cpp gltf_meshes.cpp json_depth.cpp
    shell_directory.cpp shell_reader.cpp shell_set_rules.cpp
  HEADERS gltf_meshes.h shell_reader.h
  LINK nacre::core
  LINK_PRIVATE nacre::io_files draco::draco fmt::fmt
    $<BUILD_INTERFACE:nlohmann_json::nlohmann_json> TBB::tbb)

nacre_library(io_shell_writer
  SOURCES draco_encode.cpp shell_file_json.cpp shell_writer.cpp
  HEADERS shell_writer.h
  LINK nacre::core
  LINK_PRIVATE nacre::io_files nacre::io_shell_reader draco::draco fmt::fmt
    $<BUILD_INTERFACE:nlohmann_json::nlohmann_json> TBB::tbb)
target_compile_definitions(nacre_io_shell_writer PRIVATE NACRE_VERSION="${PROJECT_VERSION}")
