find_package(PNG REQUIRED)
find_package(TIFF REQUIRED)

nacre_library(io_pictures
  SOURCES picture_file.cpp png_picture.cpp tiff_picture.cpp
  HEADERS picture_file.h png_picture.h tiff_picture.h
  LINK nacre::core
  LINK_PRIVATE nacre::io_files PNG::PNG TIFF::TIFF fmt::fmt)
