# Tests of nacre::io_tools.
find_package(fmt REQUIRED)
set(tool_tests pose_file_test.cpp)
if(NACRE_BUILD_AUTHORING)
  list(APPEND tool_tests tool_reader_test.cpp tool_damage_test.cpp small_tools.cpp)
endif()
nacre_test(io_tools
  SOURCES ${tool_tests}
  LINK nacre::io_tools fmt::fmt ZLIB::ZLIB)
