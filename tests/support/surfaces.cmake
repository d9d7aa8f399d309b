# Closed surfaces known in closed form, for tests.
add_library(nacre_test_surfaces STATIC ${CMAKE_CURRENT_LIST_DIR}/analytic_surfaces.cpp)
target_include_directories(nacre_test_surfaces PUBLIC ${PROJECT_SOURCE_DIR})
target_link_libraries(nacre_test_surfaces PUBLIC nacre::core PRIVATE nacre_defaults)
