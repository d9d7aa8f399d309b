# Tests of nacre::io_files.
nacre_test(io_files
  SOURCES atomic_file_test.cpp
  LINK nacre::io_files)

# Tests of nacre::io_volumes.
find_package(ZLIB REQUIRED)
set(volume_tests damaged_files_test.cpp nifti_volume_test.cpp slice_stack_test.cpp volume_reader_test.cpp
  volume_writer_test.cpp)
if(NACRE_WITH_ITK)
  list(APPEND volume_tests dicom_series_test.cpp metaimage_volume_test.cpp nrrd_volume_test.cpp
    real_volumes_test.cpp ../support/dicom_files.cpp)
endif()
nacre_test(io_volumes
  SOURCES ${volume_tests}
  LINK nacre::io_volumes ZLIB::ZLIB)
target_compile_definitions(io_volumes_tests PRIVATE $<$<BOOL:${NACRE_WITH_ITK}>:NACRE_WITH_ITK>)
target_link_libraries(io_files_tests PRIVATE ZLIB::ZLIB)
if(NACRE_WITH_ITK)
  find_package(fmt REQUIRED)
  set(CMAKE_MESSAGE_LOG_LEVEL WARNING)
  find_package(GDCM REQUIRED)
  unset(CMAKE_MESSAGE_LOG_LEVEL)
  target_include_directories(io_volumes_tests SYSTEM PRIVATE ${GDCM_INCLUDE_DIRS})
  target_link_libraries(io_volumes_tests PRIVATE gdcmMSFF gdcmDSED gdcmCommon fmt::fmt)
endif()
