# Fails if a program is linked to a library that is to be loaded at run time.
# Run as: cmake -D OBJDUMP=<objdump> -D PROGRAM=<file> -D LIBRARIES=<regex> -P check_not_linked.cmake
cmake_minimum_required(VERSION 3.25)

execute_process(COMMAND ${OBJDUMP} -p ${PROGRAM} OUTPUT_VARIABLE headers COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "NEEDED +[^\n]+" needed "${headers}")
if(NOT needed)
  message(FATAL_ERROR "Found no needed library in ${PROGRAM}")
endif()
foreach(library IN LISTS needed)
  if(library MATCHES "lib${LIBRARIES}")
    message(FATAL_ERROR "${PROGRAM} is linked: ${library}")
  endif()
endforeach()
