find_package(fmt REQUIRED)
find_package(ZLIB REQUIRED)
# Not find_package(NIFTI): Debian's package names library files that are elsewhere.
find_path(NACRE_NIFTI_INCLUDE_DIR nifti/nifti2_io.h REQUIRED)
find_library(NACRE_NIFTI2_LIBRARY nifti2 REQUIRED)

# nacre::io_files: files that appear under their names only when they are whole, files read by place,
# and what is said of bad ones.
nacre_library(io_files
  SOURCES atomic_file.cpp bad_file.cpp byte_source.cpp
  HEADERS atomic_file.h bad_file.h byte_source.h
  LINK nacre::core
  LINK_PRIVATE fmt::fmt)

# nacre::io_volumes: volume files and DICOM series to volumes, and back.
nacre_library(io_volumes
  SOURCES data_files.cpp dicom_magic.cpp gzip_writer.cpp metaimage_writer.cpp
    nifti_header.cpp nifti_volume.cpp nifti_writer.cpp nrrd_writer.cpp non_finite.cpp
    raw_volume.cpp slice_stack.cpp stored_samples.cpp stretch.cpp volume_checks.cpp volume_crop.cpp
    volume_reader.cpp volume_writer.cpp
  HEADERS child_process.h data_files.h dicom_extent.h dicom_magic.h dicom_series.h dicom_slice.h length_unit.h metaimage_text.h metaimage_volume.h nifti_header.h
    nifti_volume.h non_finite.h nrrd_text.h nrrd_volume.h number_list.h raw_volume.h
    slice_stack.h     stored_samples.h stretch.h volume_checks.h volume_crop.h volume_read_report.h volume_reader.h volume_writer.h
    gzip_writer.h metaimage_writer.h nifti_writer.h nrrd_writer.h
  LINK nacre::core
  LINK_PRIVATE nacre::io_files fmt::fmt ${NACRE_NIFTI2_LIBRARY} ZLIB::ZLIB)
target_include_directories(nacre_io_volumes SYSTEM PRIVATE
  ${NACRE_NIFTI_INCLUDE_DIR} ${NACRE_NIFTI_INCLUDE_DIR}/nifti)

if(NACRE_WITH_ITK)
  # Debian's GDCM lists programs that are in another package, at length and without harm.
  set(CMAKE_MESSAGE_LOG_LEVEL WARNING)
  find_package(ITK REQUIRED COMPONENTS ITKIOMeta ITKNrrdIO)
  find_package(GDCM REQUIRED)
  unset(CMAKE_MESSAGE_LOG_LEVEL)
  target_sources(nacre_io_volumes PRIVATE
    child_process.cpp dicom_extent.cpp dicom_series.cpp dicom_slice.cpp gdcm_module.cpp length_unit.cpp metaimage_text.cpp metaimage_volume.cpp nrrd_text.cpp nrrd_volume.cpp)
  # After the NIfTI library's headers: ITK brings an old znzlib.h of its own.
  target_include_directories(nacre_io_volumes SYSTEM PRIVATE ${ITK_INCLUDE_DIRS})
  target_link_libraries(nacre_io_volumes PRIVATE ${ITK_LIBRARIES} ${CMAKE_DL_LIBS})

  # All that knows GDCM is a module, loaded where a DICOM file is read (see docs/decisions/023).
  nacre_module(gdcm SOURCES gdcm_reader.cpp)
  target_include_directories(nacre_gdcm SYSTEM PRIVATE ${GDCM_INCLUDE_DIRS})
  target_link_libraries(nacre_gdcm PRIVATE nacre::core gdcmMSFF gdcmDSED gdcmCommon)
  nacre_loads_module(io_volumes gdcm)
else()
  target_sources(nacre_io_volumes PRIVATE without_itk.cpp)
endif()
