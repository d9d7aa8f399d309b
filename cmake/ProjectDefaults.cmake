# Language level, warnings and sanitizers for our own targets; dependencies never see them.
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)

add_library(nacre_defaults INTERFACE)
target_compile_features(nacre_defaults INTERFACE cxx_std_20)
target_compile_options(nacre_defaults INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wold-style-cast
  -ffp-contract=off  # same floating-point results with and without FMA hardware
  $<$<BOOL:${NACRE_WERROR}>:-Werror>)
if(NACRE_SANITIZE)
  target_compile_options(nacre_defaults INTERFACE
    -fsanitize=${NACRE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  # The sanitizer opens modules in the program's place: they are found by its old-style run path
  # alone, which holds for the libraries it loads too.
  target_link_options(nacre_defaults INTERFACE
    -fsanitize=${NACRE_SANITIZE} -Wl,--disable-new-dtags)
endif()

# nacre_library(<name> SOURCES ... HEADERS ... [LINK ...] [LINK_PRIVATE ...])
#
# One module target: nacre::<name>, headers included as "<folder>/<file>.h" from the root.
function(nacre_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;HEADERS;LINK;LINK_PRIVATE")
  add_library(nacre_${name} STATIC ${arg_SOURCES})
  add_library(nacre::${name} ALIAS nacre_${name})
  set_target_properties(nacre_${name} PROPERTIES EXPORT_NAME ${name})
  target_sources(nacre_${name} PUBLIC
    FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${arg_HEADERS})
  target_compile_features(nacre_${name} PUBLIC cxx_std_20)
  target_link_libraries(nacre_${name}
    PUBLIC ${arg_LINK}
    PRIVATE ${arg_LINK_PRIVATE} $<BUILD_INTERFACE:nacre_defaults>)
  install(TARGETS nacre_${name} EXPORT nacre_targets
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/nacre)
endfunction()

# Modules are found by the run path of the program that loads them: our own programs get it here,
# those of other projects by nacre_loads_module.
set(nacre_module_dir ${CMAKE_INSTALL_LIBDIR}/nacre)
set(CMAKE_BUILD_RPATH ${PROJECT_BINARY_DIR}/${nacre_module_dir})
set(CMAKE_INSTALL_RPATH "$ORIGIN/../${nacre_module_dir}")

# nacre_module(<name> SOURCES ...)
#
# libnacre_<name>.so, loaded at run time, for a library that costs much and is seldom needed.
function(nacre_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES")
  add_library(nacre_${name} MODULE ${arg_SOURCES})
  set_target_properties(nacre_${name} PROPERTIES
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/${nacre_module_dir}
    INSTALL_RPATH "")
  target_link_libraries(nacre_${name} PRIVATE nacre_defaults)
  install(TARGETS nacre_${name} LIBRARY DESTINATION ${nacre_module_dir})
endfunction()

# nacre_loads_module(<library> <module>)
#
# Builds the module with the library, and lets programs that link the library find it.
function(nacre_loads_module library module)
  add_dependencies(nacre_${library} nacre_${module})
  if(NOT PROJECT_IS_TOP_LEVEL)
    target_link_options(nacre_${library} INTERFACE
      $<BUILD_INTERFACE:-Wl,-rpath,${PROJECT_BINARY_DIR}/${nacre_module_dir}>)
  endif()
  target_link_options(nacre_${library} INTERFACE
    $<INSTALL_INTERFACE:-Wl,-rpath,$<INSTALL_PREFIX>/${nacre_module_dir}>)
endfunction()

# nacre_knows_kernels(<name>)
#
# Tells a folder's library which kernels are compiled beside those for what every processor has:
# NACRE_KERNEL_AVX2 and NACRE_KERNEL_AVX512 (see core/instruction_set.h).
function(nacre_knows_kernels name)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_definitions(nacre_${name} PRIVATE NACRE_KERNEL_AVX2 NACRE_KERNEL_AVX512)
  endif()
endfunction()
