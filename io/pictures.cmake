find_package(PNG REQUIRED)
find_package(TIFF REQUIRED)
find_package(ZLIB REQUIRED)

nacre_library(io_pictures
  SOURCES apng_picture.cpp picture_file.cpp png_picture.cpp tiff_picture.cpp
  HEADERS apng_picture.h picture_file.h png_picture.h tiff_picture.h
  LINK nacre::core
  LINK_PRIVATE nacre::io_files PNG::PNG TIFF::TIFF ZLIB::ZLIB fmt::fmt)
