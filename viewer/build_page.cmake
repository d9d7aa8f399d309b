# Run by the build: npm ci from the lock file, then build.mjs. Where the packages cannot be had (no
# network) the library is built without a page, and says so; with REQUIRED=ON that is an error.
cmake_minimum_required(VERSION 3.25)

function(give_up what output)
  if(REQUIRED STREQUAL "ON")
    message(FATAL_ERROR "The viewer's page: ${what}\n${output}")
  endif()
  message(WARNING "The viewer's page is left out, nacre will write no .html: ${what}\n${output}")
  file(COPY_FILE ${SOURCE}/without_page.cpp ${OUT}/page.cpp)
  file(WRITE ${OUT}/view.html "")
endfunction()

# Packages are fetched again only when the lock file has changed.
file(SHA256 ${SOURCE}/package-lock.json lock)
set(wanted "${lock} ${DEVELOP}")
set(found "")
if(EXISTS ${OUT}/packages.txt)
  file(READ ${OUT}/packages.txt found)
endif()
if(NOT found STREQUAL wanted)
  file(COPY ${SOURCE}/package.json ${SOURCE}/package-lock.json DESTINATION ${OUT})
  set(omit "")
  if(NOT DEVELOP)
    set(omit --omit=dev)
  endif()
  execute_process(
    COMMAND ${NPM} ci ${omit} --ignore-scripts --prefer-offline --no-audit --no-fund
    WORKING_DIRECTORY ${OUT} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    give_up("npm ci failed; build again when its packages can be had" "${output}")
    return()
  endif()
  file(WRITE ${OUT}/packages.txt "${wanted}")
endif()

execute_process(
  COMMAND ${NODE} ${SOURCE}/build.mjs --modules ${OUT} --out ${OUT}/view.html --cpp ${OUT}/page.cpp
  RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "The viewer's page: build.mjs failed")
endif()
