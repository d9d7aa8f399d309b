# nacre::io_tools: tool meshes (STL, OBJ, PLY, OFF) and their poses.
find_package(fmt REQUIRED)

nacre_library(io_tools
  SOURCES mesh_format.cpp pose_file.cpp text_lines.cpp
  HEADERS pose_file.h tool_reader.h
  LINK nacre::core
  LINK_PRIVATE nacre::io_files fmt::fmt)
if(NACRE_BUILD_AUTHORING)
  find_package(OpenMesh REQUIRED)
  target_sources(nacre_io_tools PRIVATE openmesh_reader.cpp plain_obj.cpp plain_off.cpp
    plain_ply.cpp plain_stl.cpp ply_header.cpp tool_reader.cpp)
  target_link_libraries(nacre_io_tools PRIVATE OpenMeshCore)
else()
  target_sources(nacre_io_tools PRIVATE without_openmesh.cpp)
endif()
