# `cmake --install` and `find_package(nacre)`.
include(CMakePackageConfigHelpers)

set(nacre_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/nacre)
install(EXPORT nacre_targets FILE nacreTargets.cmake NAMESPACE nacre::
  DESTINATION ${nacre_package_dir})
configure_package_config_file(cmake/nacreConfig.cmake.in ${PROJECT_BINARY_DIR}/nacreConfig.cmake
  INSTALL_DESTINATION ${nacre_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/nacreConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/nacreConfig.cmake ${PROJECT_BINARY_DIR}/nacreConfigVersion.cmake
  DESTINATION ${nacre_package_dir})
