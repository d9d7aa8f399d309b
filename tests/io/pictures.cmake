nacre_test(io_pictures
  SOURCES apng_picture_test.cpp picture_file_test.cpp
  LINK nacre::io_pictures ZLIB::ZLIB)
