# Tests of nacre::io_shell_reader and nacre::io_shell_writer.
find_package(draco REQUIRED)
find_package(nlohmann_json REQUIRED)

nacre_test(io_shell_files
  SOURCES gltf_meshes_test.cpp shell_file_test.cpp shell_file_damage_test.cpp small_shell_set.cpp
  LINK nacre::io_shell_reader nacre::io_shell_writer nacre_test_surfaces draco::draco
    nlohmann_json::nlohmann_json)
